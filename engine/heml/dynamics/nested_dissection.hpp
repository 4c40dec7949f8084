#pragma once
// Order of elimination with little fill (George 1973). A separator, nodes without which the graph falls into two halves
// of similar size, is eliminated after the halves, and each half is ordered likewise:
//
//     ┌───────┬─┬───────┐
//     │ half  │s│ half  │      order: half, half, s
//     └───────┴─┴───────┘
//
// A plane through the median divides the nodes; then single nodes move between the halves and the separator where that
// makes the separator smaller (Fiduccia & Mattheyses 1982). Parts of up to a thousand nodes are ordered by approximate
// minimum degree, which alone suits long bodies: it goes from both ends to the middle.
#include <heml/dynamics/node_graph.hpp>
#include <heml/math/types.hpp>

namespace heml {

/// The node eliminated k-th. position: #nodes, m; any positions give a valid order.
std::vector<int> nested_dissection(const NodeGraph& graph, const std::vector<Vec3>& position);

/// The node eliminated k-th by approximate minimum degree (Amestoy, Davis & Duff 1996).
std::vector<int> minimum_degree(const NodeGraph& graph);

}  // namespace heml
