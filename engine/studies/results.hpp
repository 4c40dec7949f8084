#pragma once
// The results of a study on disk: one line of JSON per result, appended as it is measured, so that an interrupted run
// continues where it stopped. Results of other builds of the program are ignored.
//
//   {"key":"collapse point|stvk|verlet|double","build":"8f2c…","result":{…}}
#include <filesystem>
#include <heml/scenario/json_text.hpp>
#include <map>
#include <string>

namespace heml {

class Results {
 public:
  /// Reads existing results; drops an incomplete last line. Throws InputError if the file cannot be written.
  explicit Results(const std::filesystem::path& file, std::string build = build_identity());

  /// Null: not measured yet. key: everything that determines the result except the build.
  const Json* find(const std::string& key) const;

  /// Appends a line; returns the result as the next run will read it.
  const Json& add(const std::string& key, const Json& result);

  /// Of the running executable: changes with its code, its static libraries and its compiler.
  static std::string build_identity();

 private:
  std::filesystem::path file_;
  std::string build_;
  std::map<std::string, Json> results_;
};

}  // namespace heml
