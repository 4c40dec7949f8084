#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <optional>
#include <string>
#include <utility>

namespace heml {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error, const std::string& remedy) {
  throw InputError(path.string(), "", fmt::format("cannot be written: {}", std::strerror(error)), remedy);
}

constexpr const char* disk_remedy = "check the folder, its permissions and the space left";

/// Returns 0, or errno if not all bytes were written.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

int close_for_good(int descriptor) { return ::close(descriptor) != 0 && errno != EINTR ? errno : 0; }

/// The standard stream a file is: /dev/stdout, or the file that the stream was redirected to.
std::optional<int> standard_stream(const struct stat& file) {
  for (const int number : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat stream;
    if (::fstat(number, &stream) == 0 && stream.st_dev == file.st_dev && stream.st_ino == file.st_ino) return number;
  }
  return std::nullopt;
}

/// Status of a path, links followed; none if it does not exist.
std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) == 0) return status;
  return std::nullopt;
}

/// The path with symbolic links resolved, so that a rename replaces the file and not a link to it.
fs::path without_links(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_symlink(path, failed)) return path;
  const fs::path target = fs::weakly_canonical(path, failed);
  return failed ? path : target;
}

/// A temporary name in the file's folder, so that a rename stays on one disk; unique to this process and call.
fs::path temporary_path(const fs::path& path) {
  static std::atomic<int> calls{0};
  return fmt::format("{}.{}-{}.part", path.string(), ::getpid(), calls++);
}

int open_temporary(const fs::path& temporary) {
  return ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/// Returns 0, or errno if an existing file must not be replaced.
int replace_error(const fs::path& file) { return ::access(file.c_str(), W_OK) == 0 ? 0 : errno; }

bool is_written_directly(const struct stat& status) { return !S_ISREG(status.st_mode) || standard_stream(status); }

/// Creates a temporary file in a folder and removes it; returns 0, or errno.
int create_error(const fs::path& folder) {
  const fs::path temporary = temporary_path(folder / "heml");
  const int made = open_temporary(temporary);
  if (made < 0) return errno;
  ::close(made);
  ::unlink(temporary.c_str());
  return 0;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

}  // namespace

void write_file(const fs::path& path, std::string_view bytes) {
  const auto status = status_of(path);
  if (status && S_ISDIR(status->st_mode)) fail(path, EISDIR, "give the name of a file");
  if (status && is_written_directly(*status)) {
    AppendFile out(path, AppendFile::OpenMode::append);
    out.write(bytes);
    return out.close();
  }
  const fs::path file = without_links(path), temporary = temporary_path(file);
  if (status)
    if (const int error = replace_error(file)) fail(path, error, disk_remedy);
  const int out = open_temporary(temporary);
  if (out < 0) fail(path, errno, disk_remedy);
  int error = write_all(out, bytes);
  if (!error && status && ::fchmod(out, status->st_mode & 07777) != 0) error = errno;
  const int at_end = close_for_good(out);
  if (!error) error = at_end;
  if (!error) error = ::rename(temporary.c_str(), file.c_str()) ? errno : 0;
  if (!error) return;
  ::unlink(temporary.c_str());
  fail(path, error, disk_remedy);
}

AppendFile::AppendFile(fs::path path, OpenMode mode) : path_(std::move(path)) {
  const auto status = status_of(path_);
  if (const auto stream = status ? standard_stream(*status) : std::nullopt) {  // flush what was printed before
    std::fflush(*stream == STDOUT_FILENO ? stdout : stderr);
    descriptor_ = ::fcntl(*stream, F_DUPFD_CLOEXEC, 0);
  } else {
    const int how = mode == OpenMode::truncate && (!status || S_ISREG(status->st_mode)) ? O_TRUNC : 0;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | how, 0666);
  }
  if (descriptor_ < 0) fail(path_, errno, disk_remedy);
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendFile::write(std::string_view bytes) {
  if (const int error = write_all(descriptor_, bytes)) fail(path_, error, disk_remedy);
}

std::optional<std::size_t> AppendFile::size() const {
  struct stat status;
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode) || standard_stream(status)) return std::nullopt;
  return static_cast<std::size_t>(status.st_size);
}

void AppendFile::cut(std::size_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail(path_, errno, disk_remedy);
}

void AppendFile::close() {
  if (const int error = close_for_good(std::exchange(descriptor_, -1))) fail(path_, error, disk_remedy);
}

void expect_writable_file(const fs::path& path, std::string_view option) {
  const std::string remedy = fmt::format("give another {}", option);
  if (path.empty()) throw InputError("", std::string(option), "is empty", "give the name of a file");
  const auto status = status_of(path);
  if (status && S_ISDIR(status->st_mode)) fail(path, EISDIR, "give the name of a file");
  if (status)
    if (const int error = replace_error(path)) fail(path, error, remedy);
  if (status && is_written_directly(*status)) return;
  if (const int error = create_error(folder_of(without_links(path)))) fail(path, error, remedy);
}

void expect_writable_folder(const fs::path& path, std::string_view option) {
  const std::string remedy = fmt::format("give another {}", option);
  if (path.empty()) throw InputError("", std::string(option), "is empty", "give the name of a folder");
  fs::path there = path;
  while (!status_of(there) && there.has_parent_path() && there != there.parent_path()) there = there.parent_path();
  const auto status = status_of(there);
  if (!status) there = ".";
  if (status && !S_ISDIR(status->st_mode))
    throw InputError(path.string(), "", fmt::format("cannot be made: '{}' is a file", there.string()), remedy);
  if (const int error = create_error(there)) fail(path, error, remedy);
}

void make_folder(const fs::path& path, std::string_view option) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error))
    throw InputError(path.string(), "", fmt::format("cannot be made: {}", error ? error.message() : "is a file"),
                     fmt::format("give another {}", option));
}

}  // namespace heml
