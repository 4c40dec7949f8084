#include <algorithm>
#include <app/window/frame_history.hpp>
#include <heml/scenario/skin.hpp>

namespace heml::window {
namespace {

std::size_t bytes_of(const Frame& frame) {
  std::size_t bytes = sizeof(Frame) + frame.positions.size() * sizeof(Vec3f) +
                      (frame.values.size() + frame.stretches.size() + frame.solid_values.size()) * sizeof(float) +
                      frame.solid_positions.size() * sizeof(Vec3f);
  for (const Frame& comparison : frame.comparisons) bytes += bytes_of(comparison);
  return bytes;
}

std::size_t bytes_of(const Skin& skin) {
  const TexturedSurface& surface = skin.surface;
  return surface.mesh.nodes.size() * (sizeof(Vec3) + sizeof(int) + sizeof(Tet) + sizeof(std::array<float, 4>)) +
         surface.mesh.triangles.size() * sizeof(Triangle) + surface.places.size() * sizeof(std::array<float, 2>) +
         surface.colours.size() * sizeof(Vec3f) + skin.anchors.size() * sizeof(SkinAnchor) +
         skin.same.size() * sizeof(std::uint32_t);
}

}  // namespace

std::size_t FrameHistory::bytes_at(std::size_t k) const {
  const Frame& frame = frames_[k];
  const bool has_new_skin = frame.skin && !frame.skin->anchors.empty() && (k == 0 || frames_[k - 1].skin != frame.skin);
  return bytes_of(frame) + (has_new_skin ? bytes_of(*frame.skin) : 0);
}

void FrameHistory::add(const Frame& frame) {
  if (!frames_.empty() && frame.tick < frames_.back().tick) return;
  if (!frames_.empty() && frame.tick == frames_.back().tick) {
    bytes_ -= bytes_at(frames_.size() - 1);
    frames_.back() = frame;
    bytes_ += bytes_at(frames_.size() - 1);
    return;
  }
  if (!frames_.empty() && frame.tick < frames_.back().tick + spacing_) return;
  frames_.push_back(frame);
  bytes_ += bytes_at(frames_.size() - 1);
  while (bytes_ > room_ && frames_.size() > 1) thin();
}

void FrameHistory::thin() {
  std::vector<Frame> kept;
  kept.reserve(frames_.size());
  for (std::size_t k = 0; k < frames_.size(); k += 2) kept.push_back(std::move(frames_[k]));
  frames_ = std::move(kept);
  bytes_ = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) bytes_ += bytes_at(k);
  const long gaps = std::max<long>(1, std::ssize(frames_) - 1);
  spacing_ = std::max(2 * spacing_, (frames_.back().tick - frames_.front().tick) / gaps);
}

void FrameHistory::cut_after(long tick) {
  while (!frames_.empty() && frames_.back().tick > tick) {
    bytes_ -= bytes_at(frames_.size() - 1);
    frames_.pop_back();
  }
}

void FrameHistory::share(const Frame& frame) {
  const auto is_same = [](const Frame& a, const Frame& b) {
    return a.surface_mesh->version == b.surface_mesh->version && a.surface_mesh->hidden == b.surface_mesh->hidden &&
           a.surface_mesh->constrained == b.surface_mesh->constrained;
  };
  for (Frame& seen : frames_) {
    if (is_same(seen, frame)) seen.surface_mesh = frame.surface_mesh;
    for (std::size_t k = 0; k < std::min(seen.comparisons.size(), frame.comparisons.size()); ++k) {
      Frame& body = seen.comparisons[k];
      const Frame& same = frame.comparisons[k];
      if (body.variant == same.variant && is_same(body, same)) body.surface_mesh = same.surface_mesh;
    }
  }
}

std::size_t FrameHistory::index_at(long tick) const {
  const auto after =
      std::upper_bound(frames_.begin(), frames_.end(), tick, [](long t, const Frame& frame) { return t < frame.tick; });
  return after == frames_.begin() ? 0 : static_cast<std::size_t>(after - frames_.begin()) - 1;
}

}  // namespace heml::window
