#include <doctest/doctest.h>

#include <heml/mesh/improve/transfer_fields.hpp>
#include <numeric>

#include "engine/mesh/improve/bodies.hpp"

namespace heml::improve_transfer_fields_test {

TEST_CASE("an element gets the values of the nearest one of its region") {
  TetMesh from = test::shaken_box(4, 0.1);
  from.fields = {{"number", 1, std::vector<double>(from.tets.size())},
                 {"fibre", 3, std::vector<double>(3 * from.tets.size(), 0.5)}};
  std::iota(from.fields[0].values.begin(), from.fields[0].values.end(), 0.0);
  TetMesh to = from;
  to.fields.clear();
  transfer_fields(from, to);
  CHECK(to.fields[0].values == from.fields[0].values);
  CHECK(to.fields[1].values == from.fields[1].values);
  to.regions.assign(to.tets.size(), 4);
  transfer_fields(from, to);
  for (const double source : to.fields[0].values) CHECK(from.regions[static_cast<std::size_t>(source)] == 4);
}

}  // namespace heml::improve_transfer_fields_test
