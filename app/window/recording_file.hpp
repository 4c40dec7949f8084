#pragma once
// The file that a session is recorded into, which is this program's alone while it records.
#include <filesystem>
#include <heml/scenario/scene.hpp>

namespace heml::window {

/// Locks a file against other windows that would record into it, and refuses one that holds something: a recording
/// replaces what is there. Pipes, devices and standard streams are neither locked nor refused.
class RecordingFile {
 public:
  RecordingFile() = default;  ///< none
  /// Makes the file where there is none. Throws InputError where the scene reads the file, another window records into
  /// it, it is not empty, or it cannot be written.
  RecordingFile(const std::filesystem::path& path, const Scene& scene);
  RecordingFile(RecordingFile&& other) noexcept;
  RecordingFile& operator=(RecordingFile&& other) noexcept;
  /// Unlocks the file, and removes one that was made here and has stayed empty: its session never began.
  ~RecordingFile();

 private:
  void release();

  std::filesystem::path made_;  ///< empty: it was there
  int descriptor_ = -1;         ///< open while the file is locked
};

}  // namespace heml::window
