#include <heml/base/cpu_time.hpp>
#include <heml/base/log.hpp>
#include <heml/base/thread_team.hpp>
#include <system_error>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace heml {
namespace {

constexpr std::size_t chunks_per_range = 4;               // so that others can run most of a late thread's range
constexpr std::size_t chunk_alignment = 16;               // items; avoids false sharing of cache lines
// Twice the time it takes to wake a thread, and more than the serial part between two loops of an implicit step: a
// worker that falls asleep in each of those gaps comes too late to each loop.
constexpr auto max_spin = std::chrono::microseconds(100);
constexpr int spins_per_clock_check = 32;
constexpr int max_spin_budget = 16;         // loops
constexpr double max_loss_fraction = 0.02;  // net time lost to waiting, as a fraction of the caller's time
constexpr double max_credit = 0.02;         // s; workers that save much may lose one time slice now and then
constexpr double max_serial_time =
    0.25;                             // s; bounds the effect of a pause of the whole program, which looks like a loss
constexpr double waiting_weight = 3;  // weight of time waited: it also cools caches and keeps the core from others
constexpr auto between_marks = std::chrono::milliseconds(1);  // shorter than a time slice of another program
constexpr auto max_gap = std::chrono::microseconds(100);  // between loops; in a longer gap the caller may have slept

constexpr std::uint64_t inside_mask = 0x7fff, stop_bit = 0x8000, open_bit = 0x10000;
constexpr std::uint64_t threads_of(std::uint64_t gate) { return gate >> 17 & 0x7fff; }
constexpr std::uint64_t loop_of(std::uint64_t gate) { return gate >> 32; }

void relax() {
#if defined(__SSE2__)
  _mm_pause();
#endif
}

std::size_t cores() { return std::max(1u, std::thread::hardware_concurrency()); }

double seconds(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

ThreadTeam::ThreadTeam(int threads) {
  start_workers((threads > 0 ? static_cast<std::size_t>(threads) : cores()) - 1);
  ranges_ = std::make_unique<Range[]>(workers_.size() + 1);
  limit_ = workers_.size() + 1;
}

void ThreadTeam::start_workers(std::size_t wanted) {
  workers_.reserve(wanted);
  for (std::size_t k = 0; k < wanted; ++k) {
    auto worker = std::make_unique<Worker>();
    Worker& started = *worker;
    workers_.push_back(std::move(worker));
    try {
      started.thread = std::thread([this, &started, k] { work(started, k + 1); });
    } catch (const std::system_error& error) {
      workers_.pop_back();
      warn("computing with {} of {} threads: the system starts no more ({})", k + 1, wanted + 1,
           error.code().message());
      return;
    }
  }
}

ThreadTeam::~ThreadTeam() {
  gate_.fetch_or(stop_bit);
  for (const auto& worker : workers_) wake(*worker);
  for (const auto& worker : workers_) worker->thread.join();
}

double ThreadTeam::worker_seconds() const {
  double sum = 0;
  for (const auto& worker : workers_) sum += cpu_seconds_of(worker->thread);
  return sum;
}

void ThreadTeam::run(const Loop& loop) {
  const auto began = Clock::now();
  if (began < serial_until_) return loop.call(loop.body, 0, loop.count);
  if (began - last_end_ > max_gap) mark_ = {began, cpu_seconds_of_thread()};
  open(loop);
  const std::size_t own_chunks = claim_chunks(0);
  const auto worked = Clock::now();
  close();
  update_credit(began, worked, own_chunks);
}

/// Sets up ranges and chunks, opens the loop to workers and wakes the sleeping ones.
void ThreadTeam::open(const Loop& loop) {
  loop_ = loop;
  chunk_ = 1 + (loop.count - 1) / (chunks_per_range * loop.threads);
  if (chunk_ > chunk_alignment) chunk_ = (chunk_ + chunk_alignment - 1) / chunk_alignment * chunk_alignment;
  chunks_ = (loop.count - 1) / chunk_ + 1;
  for (std::size_t r = 0; r < loop.threads; ++r) {
    ranges_[r].next.store(chunks_ * r / loop.threads * chunk_, std::memory_order_relaxed);
    ranges_[r].end = std::min(loop.count, chunks_ * (r + 1) / loop.threads * chunk_);
  }
  gate_.store(++loops_ << 32 | loop.threads << 17 | open_bit);
  for (std::size_t k = 0; k + 1 < loop.threads; ++k) wake(*workers_[k]);
}

void ThreadTeam::wake(Worker& worker) {
  if (!worker.asleep.load() || !worker.asleep.exchange(0)) return;
  worker.asleep.notify_one();
}

/// Runs chunks until none is left, those of range `own` first. Returns the number run.
std::size_t ThreadTeam::claim_chunks(std::size_t own) {
  std::size_t done = 0;
  for (std::size_t k = 0; k < loop_.threads; ++k) {
    Range& range = ranges_[(own + k) % loop_.threads];
    while (range.next.load(std::memory_order_relaxed) < range.end) {
      const std::size_t begin = range.next.fetch_add(chunk_, std::memory_order_relaxed);
      if (begin >= range.end) break;
      loop_.call(loop_.body, begin, std::min(begin + chunk_, range.end));
      ++done;
    }
  }
  return done;
}

/// Closes the loop to further workers and waits for those inside.
void ThreadTeam::close() {
  std::uint64_t gate = gate_.fetch_and(~open_bit, std::memory_order_acq_rel);
  const auto began = Clock::now();
  while (gate & inside_mask) {
    for (int k = 0; k < spins_per_clock_check && gate & inside_mask; ++k) {
      relax();
      gate = gate_.load(std::memory_order_acquire);
    }
    if (gate & inside_mask && Clock::now() - began > max_spin) std::this_thread::yield();
  }
}

/// Workers save the time that their chunks would have taken the caller. They cost the time that the caller waits for
/// them at the end, and the time that other programs run on its core while workers occupy the other cores. When
/// credit_ is negative, the caller runs serially for long enough to keep the loss within max_loss_fraction.
void ThreadTeam::update_credit(Clock::time_point began, Clock::time_point worked, std::size_t own_chunks) {
  last_end_ = Clock::now();
  double working = seconds(worked - began), lost = 0;
  if (last_end_ - mark_.wall > between_marks) {
    const Mark now{last_end_, cpu_seconds_of_thread()};
    lost = std::max(0.0, seconds(now.wall - mark_.wall) - (now.processor - mark_.processor));
    working = std::max(0.0, working - lost);
    mark_ = now;
  }
  const double seconds_per_chunk = working / static_cast<double>(std::max<std::size_t>(own_chunks, 1));
  const double saved = seconds_per_chunk * static_cast<double>(chunks_ - own_chunks);
  const double waited = seconds(last_end_ - worked) + lost;
  credit_ = std::min(credit_ + saved - waiting_weight * waited, max_credit);
  if (credit_ >= 0) return;
  const std::chrono::duration<double> serial_time(std::min(-credit_ / max_loss_fraction, max_serial_time));
  serial_until_ = last_end_ + std::chrono::duration_cast<Clock::duration>(serial_time);
  credit_ = 0;
}

void ThreadTeam::work(Worker& self, std::size_t range) {
  const FlushDenormals flush;
  std::uint64_t last = 0;
  for (;;) {
    const std::uint64_t gate = await_loop(self, range, last);
    if (gate & stop_bit) return;
    last = loop_of(gate);
    if (!enter(gate)) continue;
    claim_chunks(range);
    gate_.fetch_sub(1, std::memory_order_release);
  }
}

/// Increments the count of workers inside; returns false if the loop has been closed.
bool ThreadTeam::enter(std::uint64_t gate) {
  const std::uint64_t loop = loop_of(gate);
  while (gate & open_bit && loop_of(gate) == loop)
    if (gate_.compare_exchange_weak(gate, gate + 1, std::memory_order_acquire)) return true;
  return false;
}

/// Waits for a loop that has a range for this worker, or for the stop bit, and returns the gate. Spins first if recent
/// loops arrived within the spin time (spin_budget), then sleeps.
std::uint64_t ThreadTeam::await_loop(Worker& self, std::size_t range, std::uint64_t last) const {
  const auto is_wanted = [&](std::uint64_t gate) {
    return gate & stop_bit || (gate & open_bit && loop_of(gate) != last && range < threads_of(gate));
  };
  for (;;) {
    const auto began = Clock::now();
    do {
      for (int k = 0; k < spins_per_clock_check; ++k) {
        const std::uint64_t gate = gate_.load(std::memory_order_acquire);
        if (is_wanted(gate)) {
          self.spin_budget = std::min(self.spin_budget + 1, max_spin_budget);
          return gate;
        }
        relax();
      }
    } while (self.spin_budget > 0 && Clock::now() - began < max_spin);
    self.asleep.store(1);  // sequentially consistent: either the caller sees this, or this worker sees its gate
    if (is_wanted(gate_.load()))
      self.asleep.store(0);
    else
      self.asleep.wait(1);
    const bool would_have_paid = Clock::now() - began < 2 * max_spin;
    self.spin_budget = would_have_paid ? max_spin_budget : std::max(self.spin_budget - 1, 0);
  }
}

#if defined(__SSE2__)
FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }
#else
FlushDenormals::FlushDenormals() = default;
FlushDenormals::~FlushDenormals() = default;
#endif

}  // namespace heml
