#include <doctest/doctest.h>

#include <heml/mesh/check_ply.hpp>
#include <messages.hpp>

#include "engine/mesh/files.hpp"
#include "engine/mesh/samples.hpp"

namespace heml::check_ply_test {

namespace {

std::string refusal_of(const std::string& text) {
  return refusal([&] { check_ply("a.ply", text); });
}

// The message for the ASCII sample with `from` replaced by `to`.
std::string refusal_with(const std::string& from, const std::string& to) {
  return refusal_of(replaced(samples::ply, from, to));
}

void says(const std::string& text, const char* part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("PLY files in text and bytes pass") {
  for (const std::string& text : {samples::ply, samples::ply_little_endian, samples::ply_big_endian}) {
    CHECK(is_ply(text));
    CHECK(refusal_of(text) == "");
  }
  CHECK(refusal_of(replaced(samples::ply, "comment a", "comment element b")) == "");
  CHECK_FALSE(is_ply("v 0 0 0"));
}

TEST_CASE("sizes in a PLY file that exceed what it holds are refused by line") {
  says(refusal_with("3 1 2 3 0", "2147483648 1 2 3 0"),
       "line 21: row 2 of element 'face' has a list of 2147483648 values");
  says(refusal_with("3 1 2 3 0", "-3 1 2 3 0"), "a list of -3 values");
  says(refusal_with("3 1 2 3 0", "99999999999999999999 1 2 3 0"), "line 21: the length of a list");
  says(refusal_with("face 4", "face 4294967295"), "element 'face' has 4294967295 rows, more than the");
  says(refusal_with("vertex 4", "vertex 99999999999"), "line 5: the number of rows");
  says(refusal_with("vertex 4", "vertex -4"), "line 5: the number of rows");
  says(refusal_with("edge 0\nproperty int vertex1", "edge 1000000"), "have no properties");
  says(refusal_with("face 4", "face 5"), "the file ends where");
}

TEST_CASE("sizes in a binary PLY file are read as its header says, negative ones too") {
  const std::string big = samples::ply_big_endian, little = samples::ply_little_endian;
  const std::string three(1, '\3'), many("\x7f\xff"), negative("\xff\xff");
  says(refusal_of(replaced(big, '\0' + three, many)), "row 0 of element 'face' has a list of 32767 values");
  says(refusal_of(replaced(big, '\0' + three, negative)), "a list of -1 values");
  says(refusal_of(replaced(little, three + '\0', negative)), "a list of -1 values");
  const std::string no_sign = replaced(big, "list short", "list ushort");
  says(refusal_of(replaced(no_sign, '\0' + three, negative)), "a list of 65535 values");
  says(refusal_of(replaced(big, "vertex 4", "vertex 2000000000")), "element 'vertex' has 2000000000 rows");
  says(refusal_of(big.substr(0, big.size() - 1)), "bytes left in the file hold fewer");
}

TEST_CASE("PLY headers that are not understood are refused by line") {
  says(refusal_with("end_header\n", ""), "line 14: is no line of a PLY header: '0'");
  says(refusal_of(samples::ply.substr(0, samples::ply.find("end_header"))), "the file ends where end_header should be");
  says(refusal_with("property float y", "property real y"), "line 7: data of type 'real'");
  says(refusal_with("list uint", "list float"), "line 10: the length of a list is no integer");
  says(refusal_with("format ascii", "format utf8"), "line 2: the format is 'utf8'");
  says(refusal_with("element vertex 4\n", ""), "a property before the first element");
}

}  // namespace heml::check_ply_test
