#pragma once
// The helper process that runs assimp and TetGen, which may crash or never end.
#include <filesystem>
#include <string>
#include <vector>

namespace heml {

/// A private folder in the system's folder for temporary files; removed with all it holds.
class ScratchFolder {
 public:
  ScratchFolder();  ///< throws InputError when there is no room for it
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

struct HelperLimits {
  double seconds = 120;
  double bytes = 4e9;  ///< of memory
};

/// Runs `heml-mesher ARGUMENTS` to its end. Throws InputError about `subject` when this build has no helper or the
/// helper fails, crashes, takes too long or too much memory.
void run_helper(const std::string& subject, const std::vector<std::string>& arguments, const HelperLimits& limits);

}  // namespace heml
