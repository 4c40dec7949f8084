#include <heml/session/preconditioner_updater.hpp>

namespace heml {

PreconditionerUpdater::~PreconditionerUpdater() {
  if (thread_.joinable()) thread_.join();
}

bool PreconditionerUpdater::arrived(World& world) {
  if (work_ && !work_->done()) return false;
  const long version = world.topology()->version;
  const bool arrived = work_ && version == version_;
  if (work_) {
    thread_.join();
    work_.reset();
  }
  if (arrived || version == version_) return arrived;
  version_ = version;
  work_ = world.preconditioner_build();
  if (work_)
    thread_ = std::thread([work = work_] {
      const FlushDenormals flush;
      work->run();
    });
  return false;
}

}  // namespace heml
