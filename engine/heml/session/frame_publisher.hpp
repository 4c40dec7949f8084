#pragma once
// The frames of a session's body: what viewers ask of them, and their publication.
//
//   viewer's thread   show(), hide_regions(), carry() ─► what is asked ─┐
//   engine's thread   publish() ◄───────────────────────────────────────┘─► Mailbox ─► latest() on the viewer's thread
#include <atomic>
#include <functional>
#include <heml/scenario/skin.hpp>
#include <heml/session/comparison_runs.hpp>
#include <heml/session/mailbox.hpp>
#include <heml/session/pacer.hpp>
#include <heml/session/step_doubling_scheduler.hpp>
#include <heml/session/surface_mesh.hpp>
#include <mutex>

namespace heml {

class FramePublisher {
 public:
  /// Throws InputError as load_skin() does.
  FramePublisher(const Scene& scene, const TetMesh& mesh);

  // Called on the viewer's thread; the functions that ask return whether it is something else than before.
  enum class Part { stretches, errors, solid };
  bool show(Field field) { return field_.exchange(field) != field; }
  bool hide_regions(const std::vector<int>& regions);
  bool carry(Part part, bool wanted) { return wanted_[static_cast<std::size_t>(part)].exchange(wanted) != wanted; }
  const Frame& latest() { return frames_.front(); }
  bool is_waiting() const { return frames_.waiting(); }

  // Called on the engine's thread.
  void carried_out(const Command& command);
  void ticked(const World& world);
  bool is_due(Pacer::Time now) const;
  /// Publishes the body as it is. complete: adds what the session knows of it.
  void publish(World& world, ComparisonRuns* comparison_runs, const std::function<void(Frame&)>& complete);

 private:
  bool wants(Part part) const { return wanted_[static_cast<std::size_t>(part)]; }
  void find_errors(World& world, Frame& frame);

  Mailbox<Frame> frames_;
  std::atomic<Field> field_;
  std::array<std::atomic<bool>, 3> wanted_{};
  std::mutex mutex_;
  std::vector<int> hidden_;  ///< regions, ascending; under mutex_
  SkinAttachment skin_;
  std::shared_ptr<const SurfaceMesh> surface_mesh_;               ///< of the last frame
  std::shared_ptr<const Solid> solid_;                            ///< of the last frame that had one
  std::optional<StepDoublingScheduler> step_doubling_scheduler_;  ///< while errors are wanted
  std::optional<double> mesh_error_;                              ///< the last estimate
  Pacer::Time errors_at_{};                                       ///< wall time of the last estimate
  Pacer::Time published_{};
  Pacer::Clock::duration publish_cost_{};
};

}  // namespace heml
