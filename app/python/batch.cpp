#include <algorithm>
#include <app/python/batch.hpp>
#include <exception>

namespace heml::python {

Batch::Batch(Scene scene, int count, int threads) : team_(threads) {
  scene.solver.threads = 1;
  const WorldSetup setup = load_setup(scene);
  worlds_.push_back(std::make_shared<LiveWorld>(scene, setup));
  start_ = worlds_[0]->snapshot();
  while (worlds_.size() < static_cast<std::size_t>(count)) {
    worlds_.push_back(std::make_shared<LiveWorld>(scene, setup));
    worlds_.back()->share(*start_);
  }
}

bool Batch::step(std::vector<long>& left, Clock::time_point deadline) {
  std::vector<std::exception_ptr> errors(worlds_.size());
  team_.parallel_for(worlds_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) try {
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
