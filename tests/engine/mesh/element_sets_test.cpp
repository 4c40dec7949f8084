#include <doctest/doctest.h>

#include <heml/mesh/element_sets.hpp>
#include <numeric>

#include "engine/mesh/files.hpp"

namespace heml::element_sets_test {

namespace {

TetMesh with_regions(const ElementSets& sets, const std::vector<long long>& numbers) {
  TetMesh mesh;
  sets.put(numbers, Scanner("a.inp", "text"), mesh);
  return mesh;
}

}  // namespace

TEST_CASE("an element of several sets belongs to the smallest, one of none to region 0") {
  ElementSets sets;
  const Scanner in("a.inp", "");
  sets.add(sets.find_or_add("all", in), {1, 9});
  sets.add(sets.find_or_add("Odd", in), {1, 9, 2});
  const std::size_t pair = sets.find_or_add("pair", in);
  sets.add(pair, {3, 3});
  sets.add(pair, {4, 4});
  CHECK(sets.find_or_add("ODD", in) == 1);
  const TetMesh mesh = with_regions(sets, {9, 5, 4, 3, 2, 100});
  CHECK(mesh.regions == std::vector<int>{2, 2, 3, 3, 1, 0});
  CHECK(mesh.region_names == std::map<int, std::string>{{1, "all"}, {2, "Odd"}, {3, "pair"}});
}

TEST_CASE("a set may hold sets made before it, and none else") {
  ElementSets sets;
  const Scanner in("a.inp", "");
  sets.add(sets.find_or_add("a", in), {1, 1});
  sets.add(sets.find_or_add("b", in), {2, 2});
  const std::size_t both = sets.find_or_add("both", in);
  sets.add_set(both, "A", in);
  sets.add_set(both, "b", in);
  sets.choose("both");
  CHECK(with_regions(sets, {1, 2, 3}).regions == std::vector<int>{1, 1, 0});
  CHECK(refusal([&] { sets.add_set(0, "both", in); }).find("not given before") != std::string::npos);
  CHECK(refusal([&] { sets.add_set(both, "both", in); }).find("not given before") != std::string::npos);
}

TEST_CASE("thousands of sets that each hold all elements are refused, not worked through") {
  ElementSets sets;
  const Scanner in("a.inp", "");
  for (int s = 0; s < 5000; ++s) sets.add(sets.find_or_add("s" + std::to_string(s), in), {1, 2'000'000'000});
  std::vector<long long> numbers(10'000);
  std::iota(numbers.begin(), numbers.end(), 1);
  CHECK(refusal([&] { with_regions(sets, numbers); }).find("far more elements") != std::string::npos);
}

TEST_CASE("more sets than any mesh has are refused") {
  ElementSets sets;
  const Scanner in("a.inp", "");
  CHECK(!refusal([&] {
           for (int s = 0; s < 20'000; ++s) sets.find_or_add("s" + std::to_string(s), in);
         }).empty());
}

}  // namespace heml::element_sets_test
