// Fuzzing: small valid files with thousands of pseudo-random mutations, identical on every machine.
#include <doctest/doctest.h>

#include <random>
#include <string>

#include "engine/mesh/any_format.hpp"
#include "engine/mesh/binary_samples.hpp"
#include "engine/mesh/samples.hpp"

namespace heml::fuzz_test {

namespace {

constexpr int mutations = 4000;

bool is_digit(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '.'; }

// Replaces a random number in the text by an extreme or invalid one.
void replace_number(std::string& text, std::mt19937& random) {
  static const std::array<std::string, 14> others{
      "nan",  "inf", "1e999", "-1",         "0",           "99999999999999999999",
      "1e-9", "1",   "2",     "2147483647", "-2147483648", "9223372036854775807",
      "",     "x"};
  std::size_t begin = random() % text.size();
  while (begin < text.size() && !is_digit(text[begin])) ++begin;
  while (begin > 0 && begin < text.size() && is_digit(text[begin - 1])) --begin;
  std::size_t end = begin;
  while (end < text.size() && is_digit(text[end])) ++end;
  text.replace(begin, end - begin, others[random() % others.size()]);
}

std::string damaged(std::string text, std::mt19937& random) {
  for (unsigned left = 1 + random() % 3; left > 0 && !text.empty(); --left) {
    const std::size_t at = random() % text.size(), length = random() % 20;
    switch (random() % 6) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
        break;
      case 1:
        text[at] = static_cast<char>(random());
        break;
      case 2:
        text.resize(at);
        break;
      case 3:
        text.erase(at, length);
        break;
      case 4:
        text.insert(at, text.substr(random() % text.size(), length));
        break;
      default:
        replace_number(text, random);
    }
  }
  return text;
}

// The number of damaged files that are still valid meshes. Zero would mean that no mutation gets past the first check.
int count_survivors(std::size_t format, const std::string& text, unsigned seed) {
  REQUIRE(read_and_check(format, text));
  std::mt19937 random(seed);
  int survivors = 0;
  for (int m = 0; m < mutations; ++m) survivors += read_and_check(format, damaged(text, random));
  return survivors;
}

}  // namespace

TEST_CASE("damaged Gmsh files give a mesh or one clear error") {
  CHECK(count_survivors(0, samples::gmsh_1, 1) > 0);
  CHECK(count_survivors(0, samples::gmsh_2, 2) > 0);
  CHECK(count_survivors(0, samples::gmsh_4, 3) > 0);
  CHECK(count_survivors(0, samples::gmsh_2_data, 11) > 0);
  CHECK(count_survivors(0, samples::gmsh_4_data, 12) > 0);
  CHECK(count_survivors(0, samples::gmsh_4_binary(true), 17) > 0);
  CHECK(count_survivors(0, samples::gmsh_2_binary(), 18) > 0);
}
TEST_CASE("damaged Medit files give a mesh or one clear error") { CHECK(count_survivors(1, samples::medit, 4) > 0); }
TEST_CASE("damaged VTK files give a mesh or one clear error") {
  CHECK(count_survivors(2, samples::vtk, 5) > 0);
  CHECK(count_survivors(2, samples::vtk_5, 6) > 0);
  CHECK(count_survivors(2, samples::vtk_binary, 7) > 0);
  CHECK(count_survivors(2, samples::vtk_5_binary, 8) > 0);
}
TEST_CASE("damaged VTK XML files give a mesh or one clear error") {
  CHECK(count_survivors(3, samples::vtu, 9) > 0);
  CHECK(count_survivors(3, samples::vtu_base64, 19) > 0);
  CHECK(count_survivors(3, samples::vtu_compressed, 20) > 0);
  CHECK(count_survivors(3, samples::vtu_raw, 21) > 0);
  CHECK(count_survivors(3, samples::vtu_raw_compressed, 22) > 0);
}
TEST_CASE("damaged Abaqus files give a mesh or one clear error") { CHECK(count_survivors(6, samples::abaqus, 23) > 0); }

TEST_CASE("damaged FEBio files give a mesh or one clear error") { CHECK(count_survivors(7, samples::feb, 24) > 0); }
TEST_CASE("damaged TetGen files give a mesh or one clear error") {
  CHECK(count_survivors(4, samples::node + '\0' + samples::ele, 10) > 0);
  CHECK(count_survivors(4, samples::node + '\0' + samples::ele_attributes, 13) > 0);
}
TEST_CASE("sizes in damaged PLY files fit the file or are refused") {
  CHECK(count_survivors(5, samples::ply, 14) > 0);
  CHECK(count_survivors(5, samples::ply_little_endian, 15) > 0);
  CHECK(count_survivors(5, samples::ply_big_endian, 16) > 0);
}

}  // namespace heml::fuzz_test
