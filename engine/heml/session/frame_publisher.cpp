#include <heml/session/frame_publisher.hpp>

namespace heml {
namespace {
constexpr auto frame_interval = std::chrono::milliseconds(8);    // between published frames
constexpr auto error_interval = std::chrono::milliseconds(200);  // between estimates of the mesh error
}  // namespace

FramePublisher::FramePublisher(const Scene& scene, const TetMesh& mesh)
    : field_(scene.view.field), hidden_(scene.view.hidden), skin_(load_skin(scene, mesh)) {}

bool FramePublisher::hide_regions(const std::vector<int>& regions) {
  const std::lock_guard lock(mutex_);
  if (hidden_ == regions) return false;
  hidden_ = regions;
  return true;
}

void FramePublisher::carried_out(const Command& command) {
  if (step_doubling_scheduler_) step_doubling_scheduler_->carried_out(command);
}

void FramePublisher::ticked(const World& world) {
  if (step_doubling_scheduler_) step_doubling_scheduler_->ticked(world);
}

bool FramePublisher::is_due(Pacer::Time now) const {
  return now - published_ >= std::max<Pacer::Clock::duration>(frame_interval, 4 * publish_cost_);
}

/// Fills the frame's mesh and time errors while they are wanted.
void FramePublisher::find_errors(World& world, Frame& frame) {
  const bool wanted = wants(Part::errors);
  if (wanted != step_doubling_scheduler_.has_value()) {
    mesh_error_.reset();
    errors_at_ = {};
    if (wanted)
      step_doubling_scheduler_.emplace();
    else
      step_doubling_scheduler_.reset();
  }
  const auto now = Pacer::Clock::now();
  if (step_doubling_scheduler_ && now - errors_at_ >= error_interval) {
    const auto estimate = world.error_estimate();
    mesh_error_ = estimate ? std::optional(estimate->relative()) : std::nullopt;
    errors_at_ = now;
  }
  frame.mesh_error = mesh_error_;
  frame.time_error = step_doubling_scheduler_ ? step_doubling_scheduler_->latest() : std::nullopt;
}

void FramePublisher::publish(World& world, ComparisonRuns* comparison_runs,
                             const std::function<void(Frame&)>& complete) {
  const auto began = Pacer::Clock::now();
  Frame& frame = frames_.back();
  const std::vector<int> hidden = [&] {
    const std::lock_guard lock(mutex_);
    return hidden_;
  }();
  surface_mesh_ = make_surface_mesh(world, std::move(surface_mesh_), hidden);
  fill_frame(world, surface_mesh_, field_, 0, frame, wants(Part::stretches));
  if (wants(Part::solid) || skin_.exists())
    fill_solid(world, 0, solid_, frame);
  else
    clear_solid(frame);
  skin_.attach(world, frame);
  if (comparison_runs) comparison_runs->fill(world, frame, 0, skin_);
  find_errors(world, frame);
  complete(frame);
  frames_.publish();
  published_ = Pacer::Clock::now();
  publish_cost_ = published_ - began;
}

}  // namespace heml
