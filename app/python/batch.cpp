#include <unistd.h>

#include <algorithm>
#include <app/python/batch.hpp>
#include <exception>

namespace heml::python {

Batch::Batch(Scene scene, int count, int threads) : pool_(std::make_unique<WorkerPool>(threads)), process_(getpid()) {
  worlds_.push_back(std::make_shared<LiveWorld>(std::move(scene), 1));
  start_ = worlds_[0]->snapshot();
  while (worlds_.size() < static_cast<std::size_t>(count))
    worlds_.push_back(std::make_shared<LiveWorld>(*worlds_[0], *start_));
}

Batch::~Batch() {
  if (process_ != getpid()) static_cast<void>(pool_.release());  // a fork: its threads are not here to be ended
}

bool Batch::step(std::vector<long>& left, Clock::time_point deadline) {
  std::vector<std::exception_ptr> errors(worlds_.size());
  pool_->for_each(worlds_.size(), [&](std::size_t i) {
    try {
      if (left[i] > 0) left[i] = worlds_[i]->step(left[i], deadline);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return std::any_of(left.begin(), left.end(), [](long ticks) { return ticks > 0; });
}

}  // namespace heml::python
