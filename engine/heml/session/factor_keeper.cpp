#include <heml/session/factor_keeper.hpp>

namespace heml {

FactorKeeper::~FactorKeeper() {
  if (thread_.joinable()) thread_.join();
}

bool FactorKeeper::arrived(World& world) {
  if (work_ && !work_->done()) return false;
  const long version = world.topology()->version;
  const bool arrived = work_ && version == version_;
  if (work_) {
    thread_.join();
    work_.reset();
  }
  if (arrived || version == version_) return arrived;
  version_ = version;
  work_ = world.factor_work();
  if (work_)
    thread_ = std::thread([work = work_] {
      const FlushDenormals flush;
      work->run();
    });
  return false;
}

}  // namespace heml
