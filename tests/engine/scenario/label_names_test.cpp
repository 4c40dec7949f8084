#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <heml/base/warning_collector.hpp>
#include <heml/scenario/label_names.hpp>

namespace heml::label_names_test {
namespace {

namespace fs = std::filesystem;
using Names = std::map<int, std::string>;

/// A folder with a MetaImage file, whose header alone is read.
class Folder {
 public:
  Folder() {
    fs::create_directories(path_);
    write("scan.mha", "NDims = 3\nDimSize = 1 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n1");
  }
  ~Folder() { fs::remove_all(path_); }
  void write(const char* name, const char* text) const { std::ofstream(path_ / name) << text; }
  Names names() const { return label_names(path_ / "scan.mha"); }

 private:
  fs::path path_ = fs::temp_directory_path() / "heml_label_names";
};

}  // namespace

TEST_CASE("names of labels in JSON, either way round, plain or under labels") {
  const Folder folder;
  CHECK(folder.names().empty());
  const Names names{{1, "liver"}, {7, "vein"}};
  for (const char* text : {R"({"1": "liver", "7": "vein"})", R"({"liver": 1, "vein": 7})",
                           R"({"name": "a set", "labels": {"liver": 1, "vein": 7}})"}) {
    folder.write("scan.json", text);
    CHECK(folder.names() == names);
  }
}

TEST_CASE("names of labels in descriptions of ITK-SNAP") {
  const Folder folder;
  folder.write("scan.txt",
               "# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Clear Label\"\n"
               "    1   255    0    0        1  1  1    \"left lobe\"\n");
  CHECK(folder.names() == Names{{0, "Clear Label"}, {1, "left lobe"}});
}

TEST_CASE("a file of names that cannot be read is warned of") {
  const Folder folder;
  folder.write("scan.json", "{1: liver}");
  const WarningCollector warnings;
  CHECK(folder.names().empty());
  REQUIRE(warnings.texts().size() == 1);
  CHECK(warnings.texts()[0].find("scan.json") != std::string::npos);
}

}  // namespace heml::label_names_test
