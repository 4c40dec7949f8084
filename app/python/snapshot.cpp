#include <fmt/format.h>

#include <app/python/snapshot.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/build_identity.hpp>
#include <heml/scenario/schedule.hpp>

namespace heml::python {

Snapshot::Snapshot(std::shared_ptr<const WorldSnapshot> state, std::shared_ptr<const Scene> scene, EventLog past,
                   const Moment& moment)
    : state_(std::move(state)),
      scene_(std::move(scene)),
      past_(std::move(past)),
      moment_(moment),
      build_(build_name()),
      kernel_revision_(kernel_revision) {}

Snapshot::Snapshot(Pickled pickled)
    : scene_(std::make_shared<const Scene>(parse_scene(pickled.recording, pickled.file))),
      moment_(pickled.moment),
      build_(std::move(pickled.build)),
      kernel_revision_(pickled.kernel_revision) {
  for (const Event& event : scene_->events) past_.push(event);
}

Snapshot::Pickled Snapshot::pickled() const {
  if (moment_.halted)
    throw InputError("", "snapshot", "is of a world that had halted, which cannot be pickled",
                     "take it before the world halts");
  Scene scene = *scene_;
  scene.events = past_.events();
  scene.points.clear();
  scene.checkpoints.clear();
  scene.recorded_end.reset();
  return {build_, recording_text(scene), scene.file, kernel_revision_, moment_};
}

std::shared_ptr<const WorldSnapshot> Snapshot::state() const {
  const std::scoped_lock lock(mutex_);
  if (!state_) state_ = play();
  return state_;
}

std::shared_ptr<const WorldSnapshot> Snapshot::play() const {
  if (build_ != build_name() || kernel_revision_ != kernel_revision)
    throw InputError(
        "", "snapshot", fmt::format("was taken by the build {}, kernel revision {}", build_, kernel_revision_),
        fmt::format("this one is {}, kernel revision {}: take it again here", build_name(), kernel_revision));
  if (!plays_as_recorded(*scene_))
    throw InputError("", "snapshot", "was computed with instructions that this processor lacks", "take it again here");
  const auto world = load_world(*scene_);
  Schedule schedule(*scene_, world->setup().mesh);
  schedule.apply(*world);
  while (world->ticks() < moment_.ticks && !world->halt()) {
    world->tick();
    schedule.apply(*world);
  }
  if (world->state_hash() != moment_.hash)
    throw InputError(
        "", "snapshot",
        fmt::format("playing its past leads to the state {:016x}, not {:016x}", world->state_hash(), moment_.hash),
        "report this: the same build gives the same bits");
  return world->snapshot();
}

}  // namespace heml::python
