#include <fmt/format.h>
#include <pthread.h>

#include <app/python/live_world.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/json_text.hpp>
#include <stdexcept>
#include <utility>

namespace heml::python {
namespace {

constexpr long ticks_between_checkpoints = 500;

/// How many forks lead to this process. A forked process has none of the threads of its worlds.
std::atomic<long> forks{0};
const int counts_forks = pthread_atfork(nullptr, nullptr, [] { ++forks; });

std::atomic<std::uint64_t> numbers{0};  // of worlds

Scene with_threads(Scene scene, int threads) {
  if (threads > 0) scene.solver.threads = threads;
  return scene;
}

/// Top-level keys of a scene whose values, or the files they name, decide how its body moves between events. The mesh
/// is compared by the world itself.
Json physics_of(Scene scene) {
  scene.solver.threads = 0;
  scene.initial_positions = scene.initial_positions.filename();  // may lie elsewhere where a snapshot was pickled
  Json json = parse_json(scene_line(scene), scene.file);
  for (const char* key : {"name", "title", "description", "mesh", "outputs", "view", "skin", "recorded"})
    json.erase(key);
  return json;
}

/// The first key of physics_of() in which two scenes differ; empty: none.
std::string differing_key(const Scene& one, const Scene& other) {
  if (&one == &other) return "";  // of the same world or batch: nothing to compare
  const Json a = physics_of(one), b = physics_of(other);
  for (const Json* json : {&a, &b})
    for (const auto& [key, value] : json->items())
      if (!a.contains(key) || !b.contains(key) || a[key] != b[key]) return key;
  return "";
}

/// With undo and redo, whatever the scene's events are.
WorldSetup with_actions(WorldSetup setup) {
  setup.keeps_actions = true;
  return setup;
}

}  // namespace

LiveWorld::LiveWorld(Scene scene, int threads)
    : number_(++numbers),
      scene_(std::make_shared<const Scene>(with_threads(std::move(scene), threads))),
      world_(make_world(with_actions(load_setup(*scene_)))),
      schedule_(*scene_, world_->setup().mesh),
      recorded_(std::make_shared<const Scene>(as_recorded(*scene_, *world_))),
      process_(forks) {}

LiveWorld::LiveWorld(const LiveWorld& first, const Snapshot& start)
    : number_(++numbers),
      scene_(first.scene_),
      world_(make_world_from(*start.state())),
      schedule_(*scene_, world_->setup().mesh),
      recorded_(first.recorded_),
      process_(forks) {}

LiveWorld::~LiveWorld() {
  if (process_ != forks) {
    static_cast<void>(world_.release());  // its threads are not here to be ended
    return;
  }
  try {
    stop_recording();
  } catch (const InputError&) {
    // The file takes no more: what it holds is a recording without an end, which `heml replay` tells.
  }
}

LiveWorld::Use::Use(LiveWorld& live) : live_(live) {
  if (live_.in_use_.exchange(true))
    throw std::runtime_error("this world is in use by another thread: one thread at a time may use a world");
  const char* problem =
      !live_.world_ ? "this world is closed"
      : live_.process_ != forks
          ? "this world was made before a fork: make it anew in this process (or start processes with "
            "multiprocessing's method 'spawn')"
          : nullptr;
  if (!problem) return;
  live_.in_use_ = false;
  throw std::runtime_error(problem);
}

long LiveWorld::step(long ticks, Clock::time_point deadline) {
  const auto begin = Clock::now();
  auto now = begin;
  const auto stop = [&] {
    seconds_ += std::chrono::duration<double>(now - begin).count();
    finish_call();
  };
  try {
    while (ticks > 0 && !world_->halt() && (now <= deadline)) {
      schedule_.apply(*world_, [&](const Command& command) {
        past_.push({world_->ticks(), command});
        if (recorder_) recorder_->command(*world_, command);
      });
      world_->tick();
      if (recorder_) recorder_->ticked(*world_);
      --ticks;
      now = Clock::now();
    }
  } catch (...) {
    stop();
    throw;
  }
  stop();
  return world_->halt() ? 0 : ticks;
}

void LiveWorld::apply(Command command, const std::vector<Vec3>& points) {
  remember_state(command);
  if (!points.empty()) set_nodes(command, world_->setup().mesh, points);
  if (const Status status = world_->apply(command); !status.ok())
    throw InputError("", "event", status.message(), event_line({world_->ticks(), command}));
  past_.push({world_->ticks(), command});
  if (recorder_) recorder_->command(*world_, command);
  finish_call();
}

/// Tools that are moved at every tick change no position or velocity themselves.
void LiveWorld::remember_state(const Command& command) {
  const bool is_motion = std::holds_alternative<MoveTool>(command) || std::holds_alternative<MoveProbe>(command) ||
                         std::holds_alternative<Grasp>(command) || std::holds_alternative<Release>(command);
  if (is_motion || (before_ && before_->tick == world_->ticks())) return;
  before_ = Before{world_->ticks(), world_->state_hash()};
}

std::shared_ptr<Snapshot> LiveWorld::snapshot() {
  const long ticks = world_->ticks();
  const Snapshot::Moment moment{ticks, world_->time(), schedule_.has_begun(ticks) ? ticks + 1 : ticks,
                                world_->state_hash(), world_->halt().has_value()};
  return std::make_shared<Snapshot>(world_->snapshot(), recorded_, past_, moment);
}

/// A snapshot is pickled as its world's scene with all that was done to it, so it goes into worlds of that scene alone.
void LiveWorld::restore(const Snapshot& snapshot) {
  if (const std::string key = differing_key(snapshot.scene(), *recorded_); !key.empty())
    throw InputError("", "snapshot", fmt::format("is of another scene, which has other '{}'", key),
                     "restore it in a world of the scene it was taken of");
  if (const Status status = world_->restore(*snapshot.state()); !status.ok())
    throw InputError("", "snapshot", status.message(), "restore it in a world of the scene it was taken of");
  past_ = snapshot.past();
  schedule_.rewind(snapshot.moment().next_events);
  restored_ = true;
  if (!recorder_) return;
  stop_recording();
  throw InputError("", "restore", "the snapshot is restored, and the recording ends before it",
                   "a recording cannot go back: record a world that is not restored");
}

void LiveWorld::record(const std::filesystem::path& path) {
  if (restored_)
    throw InputError(path.string(), "", "a world that was restored cannot be recorded",
                     "start recording a world that was not");
  if (world_->halt())
    throw InputError(path.string(), "", "the world has halted: " + world_->halt()->message,
                     "start recording before it does");
  stop_recording();
  const std::vector<Event> past = past_.events();
  recorder_.emplace(path, *recorded_, *world_, ticks_between_checkpoints, past,
                    before_ && before_->tick == world_->ticks() ? std::optional(before_->hash) : std::nullopt);
  finish_call();
}

void LiveWorld::stop_recording() {
  if (!recorder_) return;
  try {
    recorder_->end(*world_);
  } catch (...) {
    recorder_.reset();
    throw;
  }
  recorder_.reset();
}

/// Whatever Python does next, the recording is complete up to here.
void LiveWorld::finish_call() {
  if (recorder_) recorder_->end_for_now(*world_);
}

SolveFacts LiveWorld::facts() const {
  SolveFacts facts;
  facts.halt = world_->halt();
  facts.converged = !facts.halt && world_->solver_stats().unconverged_steps == 0;
  facts.wall_seconds = seconds_;
  return facts;
}

void LiveWorld::close() {
  stop_recording();
  world_.reset();
}

}  // namespace heml::python
