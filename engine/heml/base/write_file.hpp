#pragma once
// Writing files. write_file() is atomic: the final name refers to the old content or to all of the new, never to a
// part.
//
//   write_file("out/report.json")   out/report.json.4711-0.part ──(complete)──rename──► out/report.json
//
// Pipes, devices and standard streams are written directly. AppendFile writes at the end instead, for output that has
// to survive a crash of the program.
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

namespace heml {

/// Replaces a file atomically. Keeps the permissions of an existing file; writes to the target of a symbolic link.
/// Throws InputError on failure, which leaves the old content. Thread-safe.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// An append-only file without buffering: a crash of the program loses nothing that was written.
class AppendFile {
 public:
  enum class OpenMode { truncate, append };  ///< of an existing file
  /// Throws InputError when it cannot be opened.
  AppendFile(std::filesystem::path path, OpenMode mode);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// Throws InputError when not all bytes can be written; some of them may have been.
  void write(std::string_view bytes);
  /// Bytes written so far, those of an existing file included; none: no regular file (a pipe, a standard stream).
  std::optional<std::size_t> size() const;
  /// Cuts the file off after so many bytes. Throws InputError.
  void cut(std::size_t size);
  /// Throws InputError for write errors that the system reports only on closing (network disks).
  void close();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Checks before long work that write_file() can write to the path; throws InputError if not. Leaves no file behind.
/// option: command-line option that the remedy names.
void expect_writable_file(const std::filesystem::path& path, std::string_view option = "--out");

/// The same for a folder that files will be written into, which need not exist yet.
void expect_writable_folder(const std::filesystem::path& path, std::string_view option = "--out");

/// Creates a folder and its parents unless they exist. Throws InputError.
void make_folder(const std::filesystem::path& path, std::string_view option = "--out");

}  // namespace heml
