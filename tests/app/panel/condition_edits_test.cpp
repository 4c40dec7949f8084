#include <doctest/doctest.h>

#include <app/panel/condition_edits.hpp>

namespace heml::condition_edits_test {

using namespace heml::panel;

namespace {

/// Nodes 0 to 2 move, 1 to 4 are fixed; 5 to 8 are pulled by 8 N in all, 5 is pressed on.
Conditions some() {
  Boundary moved{{0, 1, 2}};
  moved.translate = Vec3(0, 1, 0);
  return {{moved, {{1, 2, 3, 4}}},
          {{Load::Kind::force, {5, 6, 7, 8}, Vec3(8, 0, 0)}, {Load::Kind::pressure, {5}, Vec3::Zero(), 3}},
          20};
}

}  // namespace

TEST_CASE("nodes are fixed by the last entry, which wins") {
  const SetBoundary set = fixed(some(), {0, 3, 9});
  REQUIRE(set.entries.size() == 2);
  CHECK(set.entries[0] == some().boundary[0]);
  CHECK(set.entries[1].nodes == std::vector{0, 1, 2, 3, 4, 9});
  Conditions moving = some();
  moving.boundary.pop_back();
  const SetBoundary beside = fixed(moving, {1});
  REQUIRE(beside.entries.size() == 2);
  CHECK(beside.entries[1] == Boundary{{1}});
  CHECK(fixed({}, {4}).entries == std::vector{Boundary{{4}}});
}

TEST_CASE("single coordinates are fixed by an entry of their own") {
  const AxisSet across{{true, false, false}};
  const SetBoundary set = fixed(some(), {3, 9}, across);
  REQUIRE(set.entries.size() == 3);
  CHECK(set.entries[1] == some().boundary[1]);
  CHECK(set.entries[2].nodes == std::vector{3, 9});
  CHECK(set.entries[2].axes == across);
  const SetBoundary more = fixed({set.entries, {}, 0}, {4}, across);
  REQUIRE(more.entries.size() == 3);
  CHECK(more.entries[2].nodes == std::vector{3, 4, 9});
}

TEST_CASE("freed nodes are in no entry, and entries without nodes go") {
  const auto set = freed(some(), {0, 1, 2, 3, 11});
  REQUIRE(set);
  CHECK(set->entries == std::vector{Boundary{{4}}});
  CHECK_FALSE(freed(some(), {11}));
}

TEST_CASE("a force is added, or replaces that on the same nodes") {
  const SetLoads set = loaded(some(), {6, 7}, Vec3(0, 2, 0));
  REQUIRE(set.entries.size() == 3);
  CHECK(set.entries[2].nodes == std::vector{6, 7});
  CHECK(set.entries[2].vector == Vec3(0, 2, 0));
  const SetLoads other = loaded(some(), {5, 6, 7, 8}, Vec3(0, 2, 0));
  REQUIRE(other.entries.size() == 2);
  CHECK(other.entries[0] == some().loads[1]);
  CHECK(other.entries[1].vector == Vec3(0, 2, 0));
}

TEST_CASE("nodes that are unloaded take their share of a force with them") {
  const auto set = unloaded(some(), {5});
  REQUIRE(set);
  REQUIRE(set->entries.size() == 1);
  CHECK(set->entries[0].nodes == std::vector{6, 7, 8});
  CHECK(set->entries[0].vector == Vec3(6, 0, 0));
  CHECK_FALSE(unloaded(some(), {0}));
}

TEST_CASE("how many nodes are held and loaded") {
  CHECK(count_in(some().boundary, {0, 4, 5, 6}) == 2);
  CHECK(count_in(some().loads, {0, 4, 5, 6}) == 2);
  CHECK(count_in(std::vector<Load>{}, {1}) == 0);
}

}  // namespace heml::condition_edits_test
