#pragma once
// What a study has measured so far, on disk: a line of JSON a result, appended as it comes, so that a run that was
// interrupted goes on where it stopped. Results of another build of the program are not taken up.
//
//   {"key":"collapse point|stvk|verlet|double","build":"8f2c…","result":{…}}
#include <filesystem>
#include <heml/scenario/json_text.hpp>
#include <map>
#include <string>

namespace heml {

class Results {
 public:
  /// Reads what is there; a last line that was cut off is left out. Throws InputError when the file cannot be written.
  explicit Results(const std::filesystem::path& file, std::string build = build_identity());

  /// Null: not measured yet. key: all that decides the result but the program itself.
  const Json* find(const std::string& key) const;

  /// Appends a line; returns what the next run will read.
  const Json& add(const std::string& key, const Json& result);

  /// Of the running program: changes with every change of its code, its libraries in it, and its compiler.
  static std::string build_identity();

 private:
  std::filesystem::path file_;
  std::string build_;
  std::map<std::string, Json> results_;
};

}  // namespace heml
