#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/build_identity.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/recorder.hpp>
#include <utility>

namespace heml {

Scene as_recorded(const Scene& scene, const World& world) {
  Scene recorded = scene;
  recorded.recorded_mesh = mesh_fingerprint(world.setup().mesh);
  recorded.recorded_instructions = resolve(world.setup().instruction_set);
  recorded.recorded_by = {recording_format, kernel_revision, build_name()};
  return recorded;
}

Recorder::Recorder(const std::filesystem::path& path, const Scene& scene, const World& world, long checkpoint_every,
                   std::span<const Event> past, std::optional<std::uint64_t> hash_before)
    : every_(checkpoint_every),
      tick_(world.ticks()),
      hash_(hash_before.value_or(world.state_hash())),
      halted_(world.halt().has_value()) {
  refuse_overwriting(input_files(scene), {path}, "--record");
  const std::filesystem::path folder = path.parent_path();
  const std::string first_line =
      scene_line(past.empty() ? as_recorded(scene, world) : scene, folder.empty() ? "." : folder);
  file_ = std::make_unique<AppendFile>(path, AppendFile::OpenMode::truncate);
  write(first_line);
  for (const Event& event : past) write(event_line(event));
  if (is_before_commands(world)) checkpoint(world);
}

Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

void Recorder::command(const World& world, const Command& command) {
  moot_.push_back(event_line({world.ticks(), command}));
  const bool was_halted = std::exchange(halted_, world.halt().has_value());
  if (was_halted && halted_) return;
  for (const std::string& line : std::exchange(moot_, {})) write(line);
}

void Recorder::ticked(const World& world) {
  halted_ = world.halt().has_value();
  if (world.ticks() == tick_) return;  // halted or interrupted within it
  tick_ = world.ticks();
  hash_ = world.state_hash();
  if (tick_ % every_ == 0) checkpoint(world);
}

void Recorder::end(const World& world) {
  // A checkpoint is of the state before a tick's commands, which is gone where one of them or half a tick changed it.
  if (last_checkpoint_ != tick_ && is_before_commands(world)) checkpoint(world);
  write(last_line(world));
  if (file_) file_->close();
  file_.reset();
}

void Recorder::end_for_now(const World& world) {
  if (!file_) return;
  if (checkpoints_ == 0 && is_before_commands(world)) checkpoint(world);  // without any nothing is verified
  const std::optional<std::size_t> size = size_ ? size_ : file_->size();
  if (!size) return;
  write(last_line(world));
  size_ = size;
}

std::string Recorder::last_line(const World& world) const {
  RecordedEnd end{tick_, checkpoints_, hash_, {}, {}};
  if (world.halt()) end.halt = world.halt()->message, end.halted = true;
  return end_line(end);
}

/// Whether the state is still what it was before the commands of the coming tick.
bool Recorder::is_before_commands(const World& world) const {
  return world.ticks() == tick_ && world.state_hash() == hash_;
}

void Recorder::checkpoint(const World& world) {
  write(checkpoint_line({tick_, hash_, world.node_hashes()}));
  last_checkpoint_ = tick_;
  ++checkpoints_;
}

void Recorder::write(const std::string& line) try {
  if (!file_) return;
  if (const auto size = std::exchange(size_, std::nullopt)) file_->cut(*size);
  file_->write(line + '\n');
} catch (const InputError&) {
  file_.reset();
  throw;
}

}  // namespace heml
