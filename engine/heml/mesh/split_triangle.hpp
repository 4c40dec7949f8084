#pragma once
// A triangle divided along segments inside it, so that each becomes an edge between parts.
//
//             2                      2
//            / `.                   /|`.
//           /    `.                / |  `.
//          /  a---b `.     →      /  a---b `.
//         /   |       `.         / / |`. `.  `.
//        0----c---------1       0----c---------1      segments a–b and a–c; c lies on the side 0–1
#include <heml/mesh/tet_mesh.hpp>
#include <span>
#include <vector>

namespace heml {

/// points: #P×2, the triangle's corners first, counterclockwise; all others inside the triangle or on its sides.
/// sides[k]: the points on the side from corner k to the next, in that order, without the corners. segments: pairs of
/// points. Returns triangles of points, counterclockwise, which fill the triangle; those without area are left out.
/// Shorter edges come first (greedy triangulation: Preparata & Shamos, Computational Geometry, 1985, 6.2); of segments
/// that cross each other, the earlier one is an edge. Takes time with the fourth power of #P: for a few points.
std::vector<Triangle> split_triangle(std::span<const Eigen::Vector2d> points,
                                     const std::array<std::vector<int>, 3>& sides,
                                     std::span<const std::array<int, 2>> segments);

}  // namespace heml
