#pragma once
// Every command that a world was given, in order. Copies share their events, so that a snapshot can keep one at no
// cost; the log that goes on after a shared past copies it first.
#include <heml/world/command.hpp>
#include <memory>
#include <mutex>
#include <vector>

namespace heml::python {

/// One thread at a time uses a log; others may use copies of it.
class EventLog {
 public:
  void push(const Event& event) {
    if (!shared_) shared_ = std::make_shared<Shared>();
    std::unique_lock lock(shared_->mutex);
    if (shared_->events.size() != count_) {
      auto own = std::make_shared<Shared>();
      own->events.assign(shared_->events.begin(), shared_->events.begin() + static_cast<std::ptrdiff_t>(count_));
      lock.unlock();
      shared_ = std::move(own);
      lock = std::unique_lock(shared_->mutex);
    }
    shared_->events.push_back(event);
    ++count_;
  }

  std::vector<Event> events() const {
    if (!shared_) return {};
    const std::scoped_lock lock(shared_->mutex);
    return {shared_->events.begin(), shared_->events.begin() + static_cast<std::ptrdiff_t>(count_)};
  }

 private:
  struct Shared {
    std::mutex mutex;
    std::vector<Event> events;  ///< the first `count_` are of this log
  };
  std::shared_ptr<Shared> shared_;
  std::size_t count_ = 0;
};

}  // namespace heml::python
