#pragma once
// How files come to be. Most are written whole: under their final name there is the old content or all of the new one,
// never a part.
//
//   write_file("out/report.json")   out/report.json.4711-0.part ──(complete)──rename──► out/report.json
//
// Pipes, devices and the standard streams have no final name to protect: they are written through. What has to survive
// a crash of the program grows instead, line by line.
#include <filesystem>
#include <string_view>

namespace heml {

/// Replaces a file, or none of it: after an error what stood there still stands there. Keeps the permissions of a file
/// that is there; a link stays one. Throws InputError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file that grows. What was written has been handed to the system: a crash of the program loses none of it.
class GrowingFile {
 public:
  enum class From { start, end };  ///< replace what is there, or go on after it
  /// Throws InputError when it cannot be opened.
  GrowingFile(std::filesystem::path path, From from);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Throws InputError when not all of it can be written; part of it may have been.
  void write(std::string_view bytes);
  /// Throws InputError when the system refuses the last of it only now (network disks).
  void close();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Makes sure, before long work, that write_file() will be able to open the path. Leaves nothing behind.
/// option: what to name in the remedy ("--out"). Throws InputError.
void expect_writable_file(const std::filesystem::path& path, std::string_view option = "--out");

/// The same of a folder that files will be written into, which need not be there yet.
void expect_writable_folder(const std::filesystem::path& path, std::string_view option = "--out");

/// Makes a folder with those above it, where there is none. Throws InputError.
void make_folder(const std::filesystem::path& path, std::string_view option = "--out");

}  // namespace heml
