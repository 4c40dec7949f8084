#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <engine/mesh/files.hpp>
#include <fstream>
#include <heml/base/write_file.hpp>
#include <iterator>
#include <thread>

namespace heml::write_file_test {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

/// Limits the size of this process's files during its lifetime, to imitate a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_{};
  void (*signal_)(int) = nullptr;
};

int rename_error = 0;  // errno that rename() is to fail with; 0: it does its work

}  // namespace
}  // namespace heml::write_file_test

/// The system's, for this program: can be told to fail.
extern "C" int rename(const char* from, const char* to) noexcept {
  if (heml::write_file_test::rename_error == 0) return renameat(AT_FDCWD, from, AT_FDCWD, to);
  errno = heml::write_file_test::rename_error;
  return -1;
}

namespace heml::write_file_test {

TEST_CASE("a file that cannot take its name keeps its old content, and no other file is left") {
  const TemporaryFolder folder;
  const fs::path file = folder.file("table.csv", "old");
  for (const int error : {EACCES, EBUSY, ENOSPC, EIO}) {
    rename_error = error;
    const std::string why = refusal([&] { write_file(file, "new"); });
    const std::string none = refusal([&] { write_file(folder / "other.csv", "new"); });
    rename_error = 0;
    CHECK(why.find(file.string() + ": cannot be written: " + std::strerror(error)) == 0);
    CHECK(none.find("other.csv: cannot be written") != none.npos);
    CHECK(content(file) == "old");
    CHECK(files_in(folder / "") == 1);
  }
  write_file(file, "new");
  CHECK(content(file) == "new");
}

TEST_CASE("a file is written completely or keeps its old content, and no other file is left") {
  const TemporaryFolder folder;
  const fs::path file = folder / "table.csv";
  write_file(file, "first");
  CHECK(content(file) == "first");
  write_file(file, "second, longer");
  CHECK(content(file) == "second, longer");
  {
    const FullDisk disk(1000);
    const std::string why = refusal([&] { write_file(file, std::string(5000, 'x')); });
    CHECK(why.find((file).string() + ": cannot be written: File too large") == 0);
    CHECK(refusal([&] { write_file(folder / "new.csv", std::string(5000, 'x')); }) != "");
  }
  CHECK(content(file) == "second, longer");
  CHECK(files_in(folder / "") == 1);
}

TEST_CASE("permissions of a file and a link to it stay") {
  const TemporaryFolder folder;
  const fs::path file = folder.file("table.csv", "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("table.csv", folder / "link.csv");
  write_file(folder / "link.csv", "new");
  CHECK(fs::is_symlink(folder / "link.csv"));
  CHECK(content(file) == "new");
  CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("pipes and devices are written through") {
  const TemporaryFolder folder;
  write_file("/dev/null", "nothing");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(refusal([] { write_file("/dev/full", "something"); }).find("/dev/full: cannot be written: No space left") == 0);
  const fs::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = content(pipe); });
  write_file(pipe, "through");
  reader.join();
  CHECK(read == "through");
  CHECK(fs::is_fifo(pipe));
}

TEST_CASE("an append file truncates or continues an existing file, and reports failures") {
  const TemporaryFolder folder;
  const fs::path file = folder.file("lines", "old\n");
  {
    AppendFile lines(file, AppendFile::OpenMode::append);
    lines.write("new\n");
    CHECK(content(file) == "old\nnew\n");  // before close()
    lines.close();
  }
  AppendFile lines(file, AppendFile::OpenMode::truncate);
  lines.write("first\n");
  CHECK(content(file) == "first\n");
  const FullDisk disk(10);
  CHECK(refusal([&] { lines.write("and more than fits\n"); }).find(file.string() + ": cannot be written") == 0);
  CHECK(refusal([&] { AppendFile none(folder / "none/lines", AppendFile::OpenMode::truncate); }) != "");
}

TEST_CASE("paths that cannot be written are refused beforehand, and the check leaves no file") {
  const TemporaryFolder folder;
  const fs::path file = folder.file("file", "kept");
  expect_writable_file(file);
  expect_writable_file(folder / "new");
  expect_writable_file("/dev/null");
  expect_writable_folder(folder / "new/and/newer");
  CHECK(files_in(folder / "") == 1);
  CHECK(content(file) == "kept");
  CHECK(refusal([&] { expect_writable_file(folder / "none/new", "--json"); }).find("give another --json") !=
        std::string::npos);
  CHECK(refusal([&] { expect_writable_file(folder / ""); }).find("Is a directory") != std::string::npos);
  CHECK(refusal([&] { expect_writable_folder(file / "new"); }).find("is a file") != std::string::npos);
  CHECK(refusal([&] { expect_writable_folder("/proc/new"); }).find("/proc/new: cannot be written") == 0);
  CHECK(refusal([&] { expect_writable_file("/proc/new"); }).find("/proc/new: cannot be written") == 0);
}

}  // namespace heml::write_file_test
