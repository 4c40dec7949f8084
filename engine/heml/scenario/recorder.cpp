#include <heml/base/error.hpp>
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

Recorder::Recorder(const std::filesystem::path& path, const Scene& scene, const World& world, long checkpoint_every)
    : every_(checkpoint_every), tick_(world.ticks()), hash_(world.state_hash()), halted_(world.halt().has_value()) {
  refuse_overwriting(input_files(scene), {path}, "--record");
  const std::filesystem::path folder = path.parent_path();
  const std::string first_line = scene_line(as_recorded(scene, world), folder.empty() ? "." : folder);
  file_.emplace(path, AppendFile::OpenMode::truncate);
  write(first_line);
  checkpoint(world);
}

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
  if (last_checkpoint_ != tick_ && world.ticks() == tick_ && world.state_hash() == hash_) checkpoint(world);
  RecordedEnd end{tick_, checkpoints_, hash_, {}, {}};
  if (world.halt()) end.halt = world.halt()->message, end.halted = true;
  write(end_line(end));
  if (file_) file_->close();
  file_.reset();
}

void Recorder::checkpoint(const World& world) {
  write(checkpoint_line({tick_, hash_, world.node_hashes()}));
  last_checkpoint_ = tick_;
  ++checkpoints_;
}

void Recorder::write(const std::string& line) try {
  if (file_) file_->write(line + '\n');
} catch (const InputError&) {
  file_.reset();
  throw;
}

}  // namespace heml
