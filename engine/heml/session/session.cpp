#include <fmt/format.h>

#include <atomic>
#include <condition_variable>
#include <heml/base/cpu_time.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/session/budget_controller.hpp>
#include <heml/session/frame_publisher.hpp>
#include <heml/session/preconditioner_updater.hpp>
#include <heml/session/recovery_reporter.hpp>
#include <heml/session/session.hpp>
#include <heml/session/step_cost_estimator.hpp>
#include <heml/session/thread_balance.hpp>
#include <heml/session/undo_list.hpp>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

namespace heml {
/// Whether `next` makes `command` redundant, as later mouse positions do between two ticks.
static bool is_overtaken(const Command& command, const Command& next) {
  if (const auto* move = std::get_if<MoveTool>(&command)) {
    const auto* later = std::get_if<MoveTool>(&next);
    return later && later->hand == move->hand;
  }
  const auto *probe = std::get_if<MoveProbe>(&command), *further = std::get_if<MoveProbe>(&next);
  return probe && further && probe->path.size() == 1 && further->path.size() == 1;
}

static std::vector<int> regions_of(const TetMesh& mesh) {
  const std::set<int> regions(mesh.regions.begin(), mesh.regions.end());
  return {regions.begin(), regions.end()};
}

class Session::Impl {
 public:
  Impl(const Scene& scene, SessionOptions options)
      : options_(std::move(options)),
        world_(world_with_undo(scene)),
        regions_(regions_of(world_->setup().mesh)),
        region_names_(world_->setup().mesh.region_names),
        publisher_(scene, world_->setup().mesh),
        scene_(without_events(scene)),
        schedule_(scene, world_->setup().mesh),
        recorded_ticks_(scene.recorded_ticks.value_or(0)),
        recovery_reporter_(world_->setup().solver.recovery ? options_.recovery_file : std::filesystem::path()),
        playing_(!options_.start_paused),
        fast_forward_target_(options_.fast_forward_to),
        pacer_(world_->setup().solver.tick()) {
    if (!options_.comparisons.empty()) comparison_runs_.emplace(world_->setup(), options_.comparisons);
    if (recovery_reporter_.keeps_recording()) scene_ = as_recorded(scene_, *world_);
    if (options_.record) recorder_.emplace(*options_.record, scene_, *world_);
    const auto& budget = world_->setup().solver.budget;
    if (budget && budget->milliseconds > 0) budget_controller_.emplace(budget->milliseconds);
    if (world_->setup().solver.integrator == Integrator::automatic)
      step_cost_estimator_.emplace(world_->setup().mesh.tets.size());
    if (world_->setup().solver.threads == 0 && world_->threads() > 1) balance_.emplace(world_->threads());
    publish();
    thread_ = std::thread([this] {
      run();
      std::lock_guard lock(mutex_);
      finished_ = true;
      ended_.notify_one();
    });
  }

  ~Impl() {
    {
      // Locked: a flag set between the engine thread's look at it and its sleep would not wake it.
      std::unique_lock lock(mutex_);
      stopping_ = true;
      wake_.notify_all();
      // Let the tick under way end, so that the recording ends with it; interrupt it after 0.5 s.
      ended_.wait_for(lock, std::chrono::milliseconds(500), [this] { return finished_; });
    }
    world_->interrupt();
    if (comparison_runs_) comparison_runs_->interrupt();
    thread_.join();
    record([this](Recorder& recorder) { recorder.end(*world_); });
  }

  // Called on the viewer's thread.
  const std::vector<int>& regions() const { return regions_; }
  const std::map<int, std::string>& region_names() const { return region_names_; }
  void post(Command command) {
    {
      std::lock_guard lock(mutex_);
      queue_.push_back(std::move(command));
      ++requests_;
    }
    wake_.notify_all();
  }
  void set_playing(bool playing, long steps = 0) {
    {
      std::lock_guard lock(mutex_);
      playing_ = playing;
      single_steps_ += steps;
      if (!playing) fast_forward_target_ = 0;
    }
    wake_.notify_all();
  }
  void fast_forward_to(long tick) {
    {
      std::lock_guard lock(mutex_);
      fast_forward_target_ = tick;
      ++requests_;
    }
    wake_.notify_all();
  }
  Scene until(const Frame& moment) const {
    Scene scene = scene_;
    std::lock_guard lock(mutex_);
    scene.events.assign(history_.begin(), history_.begin() + moment.commands);
    scene.recorded_ticks = moment.tick;
    return scene;
  }
  FramePublisher& frames() { return publisher_; }
  /// asks_anew: whether frames are to be others than before.
  void publish_soon(bool asks_anew) {
    if (!asks_anew) return;
    {
      std::lock_guard lock(mutex_);
      ++requests_;
    }
    wake_.notify_all();
  }
  long requests() const { return requests_; }

 private:
  // Called on the engine thread.
  void run() {
    pacer_.restart(Pacer::Clock::now());
    while (!stopping_) {
      wait_until_due();
      if (stopping_) return;
      take_commands();
      if (may_tick()) one_tick();
      if (balance_) balance_threads();
      if (fast_forward_target_ > 0 && (world_->ticks() >= fast_forward_target_ || world_->halt())) end_fast_forward();
      if (std::exchange(show_now_, false) || published_requests_ < taken_requests_ ||
          publisher_.is_due(Pacer::Clock::now()))
        publish();
    }
  }

  /// Sleeps until the next tick is due or, while paused or halted, until there is a request.
  void wait_until_due() {
    std::unique_lock lock(mutex_);
    if (fast_forward_target_ > 0) return;
    const auto wanted = [this] {
      return stopping_ || show_now_ || published_requests_ < requests_ || single_steps_ > 0 || fast_forward_target_ > 0;
    };
    if (playing_ && !world_->halt()) {
      wake_.wait_until(lock, pacer_.due(), [this] { return stopping_ || !playing_ || fast_forward_target_ > 0; });
      return;
    }
    if (!wanted() && !frames_published_since_pause_) {
      lock.unlock();
      publish();
      frames_published_since_pause_ = true;
      lock.lock();
    }
    wake_.wait(lock, [&] { return wanted() || (playing_ && !world_->halt()); });
    frames_published_since_pause_ = false;
    if (playing_ || single_steps_ > 0 || fast_forward_target_ > 0) pacer_.restart(Pacer::Clock::now());
  }

  bool may_tick() {
    std::lock_guard lock(mutex_);
    if (world_->halt()) return false;
    if (fast_forward_target_ > 0) return world_->ticks() < fast_forward_target_;
    if (playing_) return Pacer::Clock::now() >= pacer_.due();
    if (single_steps_ == 0) return false;
    --single_steps_;
    return true;
  }

  void take_commands() {
    {
      std::lock_guard lock(mutex_);
      taken_.swap(queue_);
      taken_requests_ = requests_;
    }
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      const bool overtaken = i + 1 < taken_.size() && is_overtaken(taken_[i], taken_[i + 1]);
      if (!overtaken) carry_out(taken_[i]);
    }
    taken_.clear();
  }

  void carry_out(const Command& command) {
    if (const Status status = world_->apply(command); !status.ok()) {
      ++refusals_;
      refusal_ = status.message();
      show_now_ = true;
      return warn("{}", status.message());
    }
    if (comparison_runs_) comparison_runs_->apply(command);
    publisher_.carried_out(command);
    if (std::holds_alternative<SetRate>(command) || std::holds_alternative<StepHistory>(command) ||
        std::holds_alternative<Reset>(command))
      pacer_.set_tick(world_->setup().solver.tick(), Pacer::Clock::now());
    record([&](Recorder& recorder) { recorder.command(*world_, command); });
    undo_list_ = updated(std::move(undo_list_), *world_, command);
    std::lock_guard lock(mutex_);
    history_.push_back({world_->ticks(), command});
  }

  /// Writes to the recorder. A write error, such as a full disk, ends the recording but not the session.
  template <class Write>
  void record(const Write& write) try {
    if (recorder_) write(*recorder_);
  } catch (const InputError& error) {
    warn("{}; the recording ends here", error.what());
    recording_problem_ = error.what();
    recorder_.reset();
    show_now_ = true;
  }

  static std::unique_ptr<World> world_with_undo(const Scene& scene) {
    WorldSetup setup = load_setup(scene);
    setup.keeps_actions = true;
    return make_world(std::move(setup));
  }

  /// The scene to record: without its events, which are recorded as they are carried out.
  static Scene without_events(Scene scene) {
    scene.events.clear();
    scene.points.clear();
    scene.checkpoints.clear();
    scene.recorded_ticks = 0;
    scene.recorded_end.reset();
    return scene;
  }

  /// Ends fast-forwarding: applies the events due at this tick and restarts the pacer.
  void end_fast_forward() {
    for (const Event& event : schedule_.due(world_->ticks())) carry_out(event.command);
    fast_forward_target_ = 0;
    show_now_ = true;
    pacer_.restart(Pacer::Clock::now());
  }

  /// Whether the next tick is part of a recording, which contains the choices made by the clock.
  bool is_recorded() const { return world_->ticks() < recorded_ticks_; }

  void one_tick() {
    const auto began = Pacer::Clock::now();
    if (options_.before_tick) options_.before_tick();
    for (const Event& event : schedule_.due(world_->ticks())) carry_out(event.command);
    const bool recorded = is_recorded();
    if (!recorded && preconditioner_updater_.arrived(*world_)) carry_out(AdoptPreconditioner{});
    double waited = 0;  // s, for comparison runs
    if (comparison_runs_)
      waited = comparison_runs_->tick(*world_);
    else
      world_->tick();
    record([this](Recorder& recorder) { recorder.ticked(*world_); });
    publisher_.ticked(*world_);
    if (!recorded) apply_clock_choices(std::chrono::duration<double>(Pacer::Clock::now() - began).count() - waited);
    if (world_->halt()) show_now_ = true;
    recovery_reporter_.ticked(*world_, scene_, history_);
    const auto ended = Pacer::Clock::now();
    fast_forward_target_ > 0 ? pacer_.book_unscheduled(began, ended) : pacer_.book(began, ended);
  }

  /// Leaves cores to other threads of the process. Not recorded: the number of threads changes no bit.
  void balance_threads() {
    const double wall = std::chrono::duration<double>(Pacer::Clock::now().time_since_epoch()).count();
    if (!balance_->is_due(wall)) return;
    const double own = cpu_seconds_of_thread() + world_->worker_seconds();
    if (const auto threads = balance_->look(wall, cpu_seconds_of_process() - own)) world_->limit_threads(*threads);
  }

  /// Turns choices made by the clock into commands. seconds: wall time of the tick without comparison runs.
  void apply_clock_choices(double seconds) {
    if (budget_controller_)
      if (const auto iterations = budget_controller_->after(seconds, world_->solver_stats()))
        carry_out(SetBudget{*iterations});
    if (step_cost_estimator_ && find_integrator(world_->solver_stats().integrator) == Integrator::verlet)
      if (const auto nanoseconds = step_cost_estimator_->after(seconds, world_->substeps()))
        carry_out(SetStepCost{*nanoseconds});
  }

  void publish() {
    published_requests_ = taken_requests_;
    publisher_.publish(*world_, comparison_runs_ ? &*comparison_runs_ : nullptr,
                       [&](Frame& frame) { complete(frame); });
    if (options_.on_frame) options_.on_frame();
  }

  /// Adds to a frame what is not of the world.
  void complete(Frame& frame) const {
    frame.pace = pacer_.pace();
    frame.pace.threads = world_->threads();
    if (balance_) frame.pace.others = balance_->load_of_others();
    frame.commands = std::ssize(history_);
    frame.paused = !playing_;
    frame.fast_forward_target = fast_forward_target_;
    frame.recovery_file = recovery_reporter_.written();
    frame.recording_problem = recording_problem_;
    frame.undo_list = undo_list_;
    frame.requests = taken_requests_;
    frame.refusals = refusals_;
    frame.refusal = refusal_;
  }

  SessionOptions options_;
  std::unique_ptr<World> world_;
  const std::vector<int> regions_;
  const std::map<int, std::string> region_names_;
  FramePublisher publisher_;
  std::optional<ComparisonRuns> comparison_runs_;
  std::optional<Recorder> recorder_;
  Scene scene_;          ///< without its events
  Schedule schedule_;    ///< of the scene's events
  long recorded_ticks_;  ///< of the scene if it is a recording, else 0
  RecoveryReporter recovery_reporter_;
  std::vector<Event> history_;                 ///< every command carried out; changed under mutex_
  std::string recording_problem_;              ///< why the recording ended early
  std::shared_ptr<const UndoList> undo_list_;  ///< null before the first action
  long refusals_ = 0;                          ///< number of refused commands
  std::string refusal_;                        ///< reason of the last refusal
  mutable std::mutex mutex_;  ///< of what wakes the engine thread, and of history_; locked briefly, longest by until()
  std::condition_variable wake_, ended_;
  std::vector<Command> queue_, taken_;
  std::atomic<long> requests_{0};  ///< commands posted and frames asked for so far
  long taken_requests_ = 0;        ///< of them those whose results the next frame shows
  long published_requests_ = 0;    ///< and those of the newest frame
  long single_steps_ = 0;
  std::atomic<bool> playing_, stopping_{false};
  bool finished_ = false;  ///< whether the engine thread has ended
  bool show_now_ = false;  ///< whether a frame is due before its time
  std::atomic<long> fast_forward_target_;  ///< the tick to fast-forward to; 0: none

  std::optional<BudgetController> budget_controller_;     ///< where the scene's budget is in milliseconds
  std::optional<StepCostEstimator> step_cost_estimator_;  ///< where the scene leaves the integrator to the engine
  std::optional<ThreadBalance> balance_;  ///< where the scene leaves the number of threads to the engine
  PreconditionerUpdater preconditioner_updater_;
  Pacer pacer_;
  bool frames_published_since_pause_ = false;
  std::thread thread_;
};

Session::Session(const Scene& scene, SessionOptions options)
    : impl_(std::make_unique<Impl>(scene, std::move(options))) {}
Session::~Session() = default;
void Session::post(Command command) { impl_->post(std::move(command)); }
void Session::play() { impl_->set_playing(true); }
void Session::pause() { impl_->set_playing(false); }
void Session::step_once() { impl_->set_playing(false, 1); }
void Session::fast_forward_to(long tick) { impl_->fast_forward_to(tick); }
const std::vector<int>& Session::regions() const { return impl_->regions(); }
const std::map<int, std::string>& Session::region_names() const { return impl_->region_names(); }
Scene Session::until(const Frame& moment) const { return impl_->until(moment); }
void Session::show(Field field) { impl_->publish_soon(impl_->frames().show(field)); }
void Session::hide_regions(const std::vector<int>& regions) {
  impl_->publish_soon(impl_->frames().hide_regions(regions));
}
void Session::enable_stretches(bool wanted) {
  impl_->publish_soon(impl_->frames().carry(FramePublisher::Part::stretches, wanted));
}
void Session::enable_errors(bool wanted) {
  impl_->publish_soon(impl_->frames().carry(FramePublisher::Part::errors, wanted));
}
void Session::enable_solid(bool wanted) {
  impl_->publish_soon(impl_->frames().carry(FramePublisher::Part::solid, wanted));
}
const Frame& Session::latest() { return impl_->frames().latest(); }
bool Session::frame_waiting() const { return impl_->frames().is_waiting(); }
bool Session::has_answered(const Frame& frame) const { return frame.requests == impl_->requests(); }

}  // namespace heml
