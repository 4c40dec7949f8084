#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/recorder.hpp>

namespace heml {

Scene as_recorded(const Scene& scene, const World& world) {
  Scene recorded = scene;
  recorded.recorded_mesh = identity_of(world.setup().mesh);
  recorded.recorded_instructions = chosen(world.setup().instruction_set);
  return recorded;
}

Recorder::Recorder(const std::filesystem::path& path, const Scene& scene, const World& world, long checkpoint_every)
    : path_(path.string()), every_(checkpoint_every) {
  std::error_code error;
  if (std::filesystem::equivalent(path, scene.file, error))
    throw InputError(path_, "", "is the scene itself and would be overwritten", "record to another file");
  const Scene recorded = as_recorded(scene, world);
  const std::filesystem::path folder = path.parent_path();
  const std::string first_line = scene_line(recorded, folder.empty() ? "." : folder);
  file_.reset(std::fopen(path_.c_str(), "wb"));
  if (!file_)
    throw InputError(path_, "", fmt::format("cannot be written: {}", std::strerror(errno)),
                     "check the folder and its permissions");
  write(first_line);
  checkpoint(world);
}

void Recorder::command(const World& world, const Command& command) {
  write(event_line({world.ticks(), command}));
  last_command_ = world.ticks();
}

void Recorder::ticked(const World& world) {
  if (world.ticks() % every_ == 0) checkpoint(world);
}

void Recorder::end(const World& world) {
  // A checkpoint is of the state before a tick's commands: after one there is none to be had until it has ticked.
  if (last_checkpoint_ != world.ticks() && last_command_ != world.ticks()) checkpoint(world);
  write(json_text({{"step", world.ticks()}, {"end", true}}, path_));
  file_.reset();
}

void Recorder::checkpoint(const World& world) {
  if (!file_) return;
  write(checkpoint_line({world.ticks(), world.state_hash(), world.node_hashes()}));
  last_checkpoint_ = world.ticks();
}

void Recorder::write(const std::string& line) {
  if (!file_) return;
  const std::string whole = line + '\n';
  if (std::fwrite(whole.data(), 1, whole.size(), file_.get()) == whole.size() && std::fflush(file_.get()) == 0) return;
  warn("{}: cannot be written any further: {}; the recording ends here", path_, std::strerror(errno));
  file_.reset();
}

}  // namespace heml
