#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <app/window/recording_file.hpp>
#include <cerrno>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <utility>

namespace heml::window {
namespace {
namespace fs = std::filesystem;
}

RecordingFile::RecordingFile(const fs::path& path, const Scene& scene) {
  refuse_overwriting(input_files(scene), {path}, "--record");
  std::error_code failed;
  const bool is_there = fs::exists(path, failed);
  if (is_there && !fs::is_regular_file(path, failed)) return;
  const AppendFile file(path, AppendFile::OpenMode::append);
  if (!file.size()) return;  // a standard stream
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // Disks that lock nothing (some of networks) fail otherwise: that is no reason not to record there.
  if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    release();
    throw InputError(path.string(), "", "is being recorded into by another window of heml", "give another --record");
  }
  if (!is_there) made_ = fs::absolute(path, failed);
  if (file.size() == 0) return;
  release();
  throw InputError(path.string(), "", "holds something already, which a recording would replace",
                   "give --record the name of a new file; a recording is opened by heml run FILE");
}

RecordingFile::RecordingFile(RecordingFile&& other) noexcept { *this = std::move(other); }

RecordingFile& RecordingFile::operator=(RecordingFile&& other) noexcept {
  if (this == &other) return *this;
  release();
  made_ = std::exchange(other.made_, {});
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

RecordingFile::~RecordingFile() { release(); }

void RecordingFile::release() {
  std::error_code failed;
  if (!made_.empty() && fs::file_size(made_, failed) == 0 && !failed) fs::remove(made_, failed);
  made_.clear();
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

}  // namespace heml::window
