// The vectorised loops of terms against their functions of one slot.
#include <doctest/doctest.h>

#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/term_parts.hpp>
#include <heml/elastic/viscoelastic_term.hpp>
#include <numeric>

#include "small_body.hpp"

namespace heml::group_loops_test {

using test::sample_material;
using test::SmallBody;

namespace {

/// A group of one material whose parameters `varied` differ between elements, and positions.
template <class Real>
struct Sample {
  Material material;
  ElementGroup<Real> group;
  std::vector<Real> x;

  Sample(const Material& of, std::mt19937_64& random, double noise, const std::vector<std::size_t>& varied = {})
      : material(of) {
    SmallBody small(random, noise);
    std::vector<int> all(small.mesh.tets.size());
    std::iota(all.begin(), all.end(), 0);
    for (const std::size_t parameter : varied) {
      ElementField field{"field" + std::to_string(parameter), 1, {}};
      for (std::size_t t = 0; t < all.size(); ++t)
        field.values.push_back(material.parameters[parameter] * test::uniform(random, 0.7, 1.4));
      material.fields.push_back({parameter, field.name});
      small.mesh.fields.push_back(std::move(field));
    }
    group = make_group<Real>(small.mesh, all, material);
    x.assign(small.x.begin(), small.x.end());
  }
};

/// Checks that forces and tensions of a term have the bits of those of its slots; stiffness and energies, whose sums
/// have another order, their digits.
template <class Real>
void check_loops(const GroupTerm<Real>& term, const ElementGroup<Real>& group, const Real* x) {
  const std::size_t slots = group.volume.size(), packets = group.packets();
  const double digits = 64 * std::numeric_limits<Real>::epsilon();
  std::vector<Real> loops(12 * slots), of_slots(12 * slots);
  for (const bool add : {false, true}) {
    CHECK(term.forces(group, x, 0, packets, loops.data(), add));
    CHECK(term.GroupTerm<Real>::forces(group, x, 0, packets, of_slots.data(), add));
    CHECK(loops == of_slots);
  }
  loops.assign(tension_entries * slots, 0);
  of_slots = loops;
  term.packet_tensions(group, x, 0, packets, loops.data());
  term.GroupTerm<Real>::packet_tensions(group, x, 0, packets, of_slots.data());
  CHECK(loops == of_slots);
  loops.assign(edge_entries * slots, 0);
  of_slots = loops;
  term.stiffness(group, x, 0, packets, Real(0.7), loops.data(), false);
  term.GroupTerm<Real>::stiffness(group, x, 0, packets, Real(0.7), of_slots.data(), false);
  Real largest = 0, apart = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    largest = std::max(largest, std::abs(of_slots[i]));
    apart = std::max(apart, std::abs(loops[i] - of_slots[i]));
  }
  CHECK(largest > 0);
  CHECK(apart <= 8 * digits * largest);
  std::vector<Real> bounds(slots), bounds_of_slots(slots);
  term.frequency_bounds(group, nullptr, x, 0, packets, bounds.data(), false);
  term.GroupTerm<Real>::frequency_bounds(group, nullptr, x, 0, packets, bounds_of_slots.data(), false);
  for (std::size_t s = 0; s < slots; ++s) CHECK(std::abs(bounds[s] - bounds_of_slots[s]) <= 1e-4f * bounds_of_slots[s]);
  std::vector<double> energies(packets), energies_of_slots(packets);
  term.energies(group, x, 0, packets, 0.7, energies.data(), false);
  term.GroupTerm<Real>::energies(group, x, 0, packets, 0.7, energies_of_slots.data(), false);
  for (std::size_t p = 0; p < packets; ++p)
    CHECK(std::abs(energies[p] - energies_of_slots[p]) <= digits * std::abs(energies_of_slots[p]));
}

/// Von Mises stress as plastic flow sees it.
template <class Real>
double mises_of(const GroupTerm<Real>& law, const ElementGroup<Real>& group, const Real* x, std::size_t s) {
  const auto rest = rest_shape(group, s);
  const auto kinematics = full_kinematics(group, x, s, rest);
  Real factor[3][3], C[6];
  cholesky3(rest.A, factor);
  into_rest_frame(factor, kinematics.G, C);
  const auto stress = law.deviatoric_stress(group, s, symmetric_eigen3(C).value, kinematics.at.J);
  return std::sqrt(1.5) * static_cast<double>(stress.norm());
}

}  // namespace

TEST_CASE_TEMPLATE("loops of every law give the bits of its slots, uniform or with parameters of each element", Real,
                   float, double) {
  std::mt19937_64 random(61);
  for (const auto law : test::law_names())
    for (const bool varied : {false, true}) {
      CAPTURE(std::string(law));
      CAPTURE(varied);
      const Material material = sample_material(law);
      std::vector<std::size_t> parameters;
      if (varied && material.parameters.size() > 1) parameters = {material.parameters.size() - 1, 0};
      const Sample<Real> sample(material, random, 0.05, parameters);
      check_loops(*make_law_term<Real>(sample.material, false, false), sample.group, sample.x.data());
    }
}

TEST_CASE_TEMPLATE("loops of viscosity and relaxation give the bits of their slots, step after step", Real, float,
                   double) {
  std::mt19937_64 random(62);
  for (const char* law : {"neo_hookean_iso", "ogden", "mooney_rivlin"})
    for (const std::size_t branches : {0, 1, 3}) {
      CAPTURE(law);
      CAPTURE(branches);
      Material material = sample_material(law);
      material.viscosity = 0.7;
      material.bulk_viscosity = 0.4;
      for (std::size_t b = 0; b < branches; ++b) material.relaxation.push_back({0.3 / (1.0 + b), 0.02 * (1.0 + b)});
      const Sample<Real> sample(material, random, 0.05);
      ViscoelasticTerm<Real> term(make_law_term<Real>(material, false, true), material);
      std::vector<Real> x = sample.x;
      term.reset_history(sample.group, x.data());
      for (int step = 0; step < 3; ++step) {
        term.begin_step(Real(0.01));
        for (Real& value : x) value *= Real(1.03);
        check_loops(term, sample.group, x.data());
        term.commit(sample.group, x.data());
        for (std::size_t s = 0; s < sample.group.volume.size(); ++s) {
          Real present[12] = {};
          term.add_present(sample.group, s, x.data(), 1, present);
          for (std::size_t i = 0; i < (branches > 0 ? 12u : 6u); ++i) CHECK(term.state_of(s)[i] == present[i]);
        }
      }
    }
}

TEST_CASE_TEMPLATE("bounds of the von Mises stress are no less than it, and near it away from rest", Real, float,
                   double) {
  std::mt19937_64 random(63);
  for (const auto law : test::law_names())
    for (const double noise : {1e-6, 1e-3, 0.15}) {
      CAPTURE(std::string(law));
      CAPTURE(noise);
      Material material = sample_material(law);
      const Sample<Real> sample(material, random, noise);
      const auto term = make_law_term<Real>(material, false, false);
      std::vector<Real> bounds(sample.group.volume.size());
      term->mises_bounds(sample.group, sample.x.data(), 0, sample.group.packets(), bounds.data());
      if (std::isinf(bounds[0])) continue;
      double largest = 0, farthest = 0;
      for (std::size_t s = 0; s < bounds.size(); ++s) {
        const double stress = mises_of(*term, sample.group, sample.x.data(), s);
        CHECK(static_cast<double>(bounds[s]) >= 0.9999 * stress);
        largest = std::max(largest, stress);
        farthest = std::max(farthest, static_cast<double>(bounds[s]) - stress);
      }
      if (noise > 0.1) CHECK(farthest <= (std::is_same_v<Real, float> ? 0.02 : 1e-8) * largest);
    }
  const Sample<Real> sample(sample_material("mooney_rivlin"), random, 0.1);
  std::vector<Real> bounds(sample.group.volume.size());
  make_law_term<Real>(sample.material, false, false)
      ->mises_bounds(sample.group, sample.x.data(), 0, sample.group.packets(), bounds.data());
  if (has_avx2()) CHECK(std::isfinite(bounds[0]));
}

}  // namespace heml::group_loops_test
