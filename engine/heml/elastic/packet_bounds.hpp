#pragma once
// The maximum of a bound over all packets of elements, evaluated step after step. A packet whose bound was far below
// the maximum cannot have reached it since: only those that may have are evaluated again.
//
//   bound:   | 0.3 | 1.0 | 0.9 | 0.4 | ... one a packet, those of all parts of a body in turn
//   age:     |  14 |   2 |   6 |  30 | ... steps since it was evaluated
//
// A packet is due
// - where 2 · age · growth ≥ largest − bound, growth the fastest that any bound was seen to grow, a step: so always the
//   largest;
// - at max_age;
// - where it is watched: something acts on its elements, whose bounds may grow without notice.
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace heml {

template <class Real>
class PacketBounds {
 public:
  static constexpr int max_age = 32;  ///< steps

  /// All packets are due the next two times: a growth is known from two evaluations.
  void forget();
  /// Packets that are due each time from now on (ascending).
  void watch(std::vector<int> packets) { watched_ = std::move(packets); }

  /// Begins an evaluation `steps` after the last one. packets: how many there are; another number than before:
  /// forget().
  void begin(std::size_t packets, int steps);
  /// Those to evaluate, ascending.
  const std::vector<int>& due() const { return due_; }
  /// The bound of a due packet, once each. Threads: any, each its own packets.
  void set(std::size_t packet, Real bound) { seen_[packet] = bound; }
  /// The maximum of all packets' last bounds; NaN if one of them is.
  Real end();

  std::size_t bytes() const;

 private:
  std::vector<Real> bound_, seen_;  ///< of the evaluation before, and of this one
  std::vector<std::uint8_t> age_;
  std::vector<int> watched_, due_;
  Real largest_ = 0, growth_ = 0;                                                   ///< growth: a step
  enum class Known { nothing, bounds, bounds_and_growth } known_ = Known::nothing;  ///< bounds alone: all are due
};

}  // namespace heml
