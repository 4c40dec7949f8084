#pragma once
// Three slots and one atomic: a writer that never waits and a reader whose slot stays as it is while it looks.
//
//   writer fills [back] ──swap──► [middle, fresh?] ◄──swap── reader looks at [front]
#include <array>
#include <atomic>

namespace heml {

template <class T>
class Mailbox {
 public:
  /// Writer's slot, to be filled before publish(). Holds what was there three rounds ago: no allocation once warm.
  T& back() { return slots_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & 3u; }

  /// Reader's: the newest published, unchanged until the next call.
  const T& front() {
    if (waiting()) front_ = middle_.exchange(front_, std::memory_order_acq_rel) & 3u;
    return slots_[front_];
  }
  bool waiting() const { return middle_.load(std::memory_order_acquire) & fresh; }

 private:
  static constexpr unsigned fresh = 4;
  std::array<T, 3> slots_{};
  unsigned back_ = 0, front_ = 1;
  std::atomic<unsigned> middle_{2};
};

}  // namespace heml
