#pragma once
// Triple buffer: three slots and one atomic. One writer and one reader thread; neither waits, and the reader's slot
// does not change while it is read.
//
//   writer fills [back] ──swap──► [middle, fresh?] ◄──swap── reader reads [front]
#include <array>
#include <atomic>

namespace heml {

template <class T>
class Mailbox {
 public:
  /// Writer's slot, to be filled before publish(). Holds an older value, whose memory can be reused.
  T& back() { return slots_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & 3u; }

  /// The newest published value; unchanged until the reader's next call.
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
