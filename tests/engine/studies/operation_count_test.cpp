// Operation counts of the laws, from the element code run with a counting scalar.
#include <doctest/doctest.h>

#include <heml/elastic/tension.hpp>
#include <heml/mesh/generate.hpp>
#include <studies/operation_count.hpp>

#include "engine/materials/sample_materials.hpp"

namespace heml::operation_count_test {

namespace {

const Vec3 rest_nodes[4] = {{0, 0, 0}, {0.1, 0.01, 0}, {0.02, 0.12, 0}, {0.01, 0.03, 0.09}};

/// Corner forces of one stretched element with any scalar.
template <class Real, class L>
std::array<double, 12> forces(const L& law) {
  Mat3 Dm;
  Dm << rest_nodes[1] - rest_nodes[0], rest_nodes[2] - rest_nodes[0], rest_nodes[3] - rest_nodes[0];
  const Mat3 g = Dm.inverse(), A = g * g.transpose();
  const Vec3 m = g * Vec3::UnitX();
  RestShape<Real> rest;
  const double entries[6] = {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(0, 2), A(1, 2)};
  for (int i = 0; i < 6; ++i) rest.A[i] = Real(entries[i]);
  for (int i = 0; i < 3; ++i) rest.fibre[i] = Real(m[i]);
  rest.volume = Real(Dm.determinant() / 6);
  Real x[4][3], out[12];
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = Real(rest_nodes[a][i] * (i == 0 ? 1.2 : 0.9));
  corner_forces(law, x[0], x[1], x[2], x[3], rest, out);
  std::array<double, 12> result;
  for (std::size_t i = 0; i < 12; ++i) result[i] = static_cast<double>(out[i]);
  return result;
}

template <class L>
Operations operations_of_law(const Material& material) {
  const L law = law_from<L, CountingScalar>(material.parameters);
  return operations_of([&] { forces<CountingScalar>(law); });
}

}  // namespace

TEST_CASE("every law runs on a counting scalar, gives the same forces, and says what it costs") {
  for (std::size_t index = 0; index < law_count; ++index)
    visit_law(index, false, []<class Tag, bool continued>(Tag, std::bool_constant<continued>) {
      if constexpr (!continued) {  // continued laws do not support CountingScalar
        using Counting = typename Tag::template Law<CountingScalar, false>;
        CAPTURE(std::string(Tag::name));
        const Material material = test::sample_material(Tag::name);
        using Plain = typename Tag::template Law<double, false>;
        const auto expected = forces<double>(law_from<Plain, double>(material.parameters));
        const auto counted = forces<CountingScalar>(law_from<Counting, CountingScalar>(material.parameters));
        for (std::size_t i = 0; i < 12; ++i) CHECK(counted[i] == expected[i]);
        const Operations c = operations_of_law<Counting>(material);
        MESSAGE(std::string(Tag::name) << ": " << c.multiplications << " multiplications, " << c.additions
                                       << " additions, " << c.others << " others");
        CHECK(c.multiplications > 50);
        CHECK(operations_of_law<Counting>(material) == c);
      }
    });
}

TEST_CASE("one more multiplication is one more counted") {
  struct Dearer : StVK<CountingScalar, false> {
    FirstDerivatives<CountingScalar> first_derivatives(const Invariants<CountingScalar>& at) const {
      auto s = StVK<CountingScalar, false>::first_derivatives(at);
      s.w1 = s.w1 * CountingScalar(1);
      return s;
    }
  };
  const StVK<CountingScalar, false> plain{1e3, 1e3};
  const Operations before = operations_of([&] { forces<CountingScalar>(plain); });
  const Operations after = operations_of([&] { forces<CountingScalar>(Dearer{plain}); });
  CHECK(after.multiplications == before.multiplications + 1);
  CHECK(after.additions == before.additions);
}

TEST_CASE("a body takes what its elements take, and twelve additions each to sum at nodes") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2});
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {1.1 * X.x(), X.y(), X.z()});
  const Material material = test::sample_material("stvk");
  const Operations element = operations_of_law<StVK<CountingScalar, false>>(material);
  const Operations body = force_operations(mesh, material, x.data());
  const long tets = static_cast<long>(mesh.tets.size());
  CHECK(body.multiplications == tets * element.multiplications);
  CHECK(body.additions == tets * (element.additions + 12));
}

TEST_CASE("an element's operations are those of a body's elements, and springs have none") {
  for (const char* law : {"stvk", "mooney_rivlin", "hgo"}) {
    const Material material = test::sample_material(law);
    const TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {1, 1, 1});
    std::vector<double> x;
    for (const Vec3& X : mesh.nodes) x.insert(x.end(), {1.1 * X.x(), X.y(), X.z()});
    const Operations body = force_operations(mesh, material, x.data());
    const auto element = element_operations(material);
    REQUIRE(element);
    CHECK(body.multiplications == 5 * element->multiplications);
    CHECK(body.additions == 5 * (element->additions + 12));
  }
  CHECK_FALSE(element_operations(test::sample_material("mass_spring")));
}

}  // namespace heml::operation_count_test
