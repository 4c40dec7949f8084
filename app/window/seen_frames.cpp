#include <algorithm>
#include <app/window/seen_frames.hpp>

namespace heml::window {
namespace {

std::size_t bytes_of(const Frame& frame) {
  std::size_t bytes = sizeof(Frame) + frame.positions.size() * sizeof(Vec3f) +
                      (frame.values.size() + frame.stretches.size()) * sizeof(float);
  for (const Frame& beside : frame.beside) bytes += bytes_of(beside);
  return bytes;
}

}  // namespace

void SeenFrames::take(const Frame& frame) {
  if (!frames_.empty() && frame.tick < frames_.back().tick) return;
  if (!frames_.empty() && frame.tick == frames_.back().tick) {
    bytes_ -= bytes_of(frames_.back());
    frames_.back() = frame;
    bytes_ += bytes_of(frame);
    return;
  }
  if (!frames_.empty() && frame.tick < frames_.back().tick + spacing_) return;
  frames_.push_back(frame);
  bytes_ += bytes_of(frame);
  if (bytes_ > room_) thin();
}

void SeenFrames::thin() {
  std::vector<Frame> kept;
  kept.reserve(frames_.size());
  for (std::size_t k = 0; k < frames_.size(); k += 2) kept.push_back(std::move(frames_[k]));
  frames_ = std::move(kept);
  bytes_ = 0;
  for (const Frame& frame : frames_) bytes_ += bytes_of(frame);
  const long gaps = std::max<long>(1, std::ssize(frames_) - 1);
  spacing_ = std::max(2 * spacing_, (frames_.back().tick - frames_.front().tick) / gaps);
}

void SeenFrames::cut_after(long tick) {
  while (!frames_.empty() && frames_.back().tick > tick) {
    bytes_ -= bytes_of(frames_.back());
    frames_.pop_back();
  }
}

void SeenFrames::share(const Frame& frame) {
  for (Frame& seen : frames_) {
    if (seen.skin->version == frame.skin->version) seen.skin = frame.skin;
    for (std::size_t k = 0; k < std::min(seen.beside.size(), frame.beside.size()); ++k) {
      Frame& body = seen.beside[k];
      const Frame& same = frame.beside[k];
      if (body.way == same.way && body.skin->version == same.skin->version) body.skin = same.skin;
    }
  }
}

std::size_t SeenFrames::place_of(long tick) const {
  const auto after =
      std::upper_bound(frames_.begin(), frames_.end(), tick, [](long t, const Frame& frame) { return t < frame.tick; });
  return after == frames_.begin() ? 0 : static_cast<std::size_t>(after - frames_.begin()) - 1;
}

}  // namespace heml::window
