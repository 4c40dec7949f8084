#include <doctest/doctest.h>

#include <app/panel/node_selection.hpp>

namespace heml::node_selection_test {

using panel::NodeSelection;
using How = NodeSelection::How;

TEST_CASE("a selection is replaced, added to and taken from") {
  NodeSelection selection;
  CHECK(selection.is_empty());
  selection.take({2, 5, 9}, How::add);
  CHECK(selection.nodes() == std::vector{2, 5, 9});
  selection.take({1, 5}, How::add);
  CHECK(selection.nodes() == std::vector{1, 2, 5, 9});
  selection.take({2, 3, 9}, How::remove);
  CHECK(selection.nodes() == std::vector{1, 5});
  selection.take({7}, How::replace);
  CHECK(selection.nodes() == std::vector{7});
  selection.take({}, How::replace);
  CHECK(selection.is_empty());
}

TEST_CASE("a selection drops the nodes that a smaller mesh does not have") {
  NodeSelection selection;
  selection.take({1, 5, 7, 8}, How::replace);
  selection.keep_below(7);
  CHECK(selection.nodes() == std::vector{1, 5});
  selection.keep_below(0);
  CHECK(selection.is_empty());
}

}  // namespace heml::node_selection_test
