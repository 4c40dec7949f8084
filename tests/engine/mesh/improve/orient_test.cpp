#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <heml/mesh/improve/orient.hpp>

#include "engine/mesh/improve/bodies.hpp"

namespace heml::improve_orient_test {

TEST_CASE("another order of nodes is repaired, an inverted element is found") {
  TetMesh mesh = make_box(Vec3::Ones(), {3, 3, 3});
  for (std::size_t t = 0; t < mesh.tets.size(); t += 3) std::swap(mesh.tets[t][0], mesh.tets[t][1]);
  TetMesh copy = mesh;
  CHECK(orient_elements(copy).empty());
  for (std::size_t t = 0; t < copy.tets.size(); ++t) CHECK(test::volume_of(copy, t) > 0);

  const int inner = 1 + 4 + 16;  // moved out through the faces opposite it
  mesh.nodes[inner] += Vec3(0.5, 0.1, 0.05);
  const std::vector<int> inverted = orient_elements(mesh);
  CHECK(!inverted.empty());
  for (const int t : inverted) CHECK(test::volume_of(mesh, static_cast<std::size_t>(t)) <= 0);
}

TEST_CASE("a face of three elements is refused by number") {
  TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 2}},
               {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}},
               {0, 0, 0},
               "three.msh"};
  CHECK_THROWS_WITH_AS(orient_elements(mesh),
                       "three.msh: element 2: is the third with the face of nodes 0, 1 and 2, after elements 0 and 1 "
                       "(remove elements that are given twice or overlap)",
                       InputError);
}

TEST_CASE("a part without a surface is refused, also beside a body") {
  TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}},
               {{0, 1, 2, 3}, {4, 5, 6, 7}, {4, 5, 6, 7}},
               {0, 0, 0},
               "twice.msh"};
  CHECK_THROWS_WITH_AS(orient_elements(mesh),
                       "twice.msh: element 1: is of a part of 2 elements without a surface: they overlap "
                       "(remove elements that are given twice or overlap)",
                       InputError);
}

}  // namespace heml::improve_orient_test
