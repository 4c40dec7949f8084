#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <heml/base/warning_collector.hpp>
#include <heml/scenario/label_names.hpp>

namespace heml::label_names_test {
namespace {

using Names = std::map<int, std::string>;

/// A folder with a MetaImage file, whose header alone is read.
class ScanFolder {
 public:
  ScanFolder() { write("scan.mha", "NDims = 3\nDimSize = 1 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n1"); }
  void write(const char* name, const char* text) const { folder_.file(name, text); }
  Names names() const { return label_names(folder_ / "scan.mha"); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("names of labels in JSON, either way round, plain or under labels") {
  const ScanFolder folder;
  CHECK(folder.names().empty());
  const Names names{{1, "liver"}, {7, "vein"}};
  for (const char* text : {R"({"1": "liver", "7": "vein"})", R"({"liver": 1, "vein": 7})",
                           R"({"name": "a set", "labels": {"liver": 1, "vein": 7}})"}) {
    folder.write("scan.json", text);
    CHECK(folder.names() == names);
  }
}

TEST_CASE("names of labels in descriptions of ITK-SNAP") {
  const ScanFolder folder;
  folder.write("scan.txt",
               "# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Clear Label\"\n"
               "    1   255    0    0        1  1  1    \"left lobe\"\n");
  CHECK(folder.names() == Names{{0, "Clear Label"}, {1, "left lobe"}});
}

TEST_CASE("a file of names that cannot be read is warned of") {
  const ScanFolder folder;
  folder.write("scan.json", "{1: liver}");
  const WarningCollector warnings;
  CHECK(folder.names().empty());
  REQUIRE(warnings.texts().size() == 1);
  CHECK(warnings.texts()[0].find("scan.json") != std::string::npos);
}

}  // namespace heml::label_names_test
