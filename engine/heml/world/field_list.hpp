#pragma once
// The one list of fields: a row for each, in the order of the enum. Scene files, panel, legend and colours read it.
#include <Eigen/Eigenvalues>
#include <array>
#include <heml/elastic/body.hpp>
#include <heml/world/world.hpp>

namespace heml {

enum class FieldScale {
  from_zero,   ///< 0 to the maximum
  about_one,   ///< symmetric about 1, never below 0 but J of inverted elements
  about_zero,  ///< symmetric about 0
};

/// What an element's value is made of.
struct ElementTensors {
  Mat3 F;       ///< deformation gradient
  Mat3 cauchy;  ///< Pa
};

/// A row has at most one function; Field::none has none, and neither has Field::error, which is of the whole body.
struct FieldInfo {
  Field field;
  std::string_view name;   ///< in scene files
  std::string_view title;  ///< in the panel
  std::string_view label;  ///< above the colour map
  std::string_view unit;   ///< SI; empty: a ratio
  FieldScale scale;
  std::string_view meaning;
  double (*of_node)(const Vec3& rest, const Vec3& now) = nullptr;
  double (*of_state)(const ElementState<double>&) = nullptr;
  double (*of_tensors)(const ElementTensors&) = nullptr;
};

namespace fields {
/// Ascending.
inline Vec3 principal(const Mat3& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}
/// Green–Lagrange.
inline Mat3 strain(const ElementTensors& e) { return (e.F.transpose() * e.F - Mat3::Identity()) / 2; }

template <int i>
double displacement(const Vec3& rest, const Vec3& now) {
  return now[i] - rest[i];
}
template <int i, int j>
double stress(const ElementTensors& e) {
  return e.cauchy(i, j);
}
template <int i>
double principal_stress(const ElementTensors& e) {
  return principal(e.cauchy)[i];
}
template <int i, int j>
double strain_component(const ElementTensors& e) {
  return strain(e)(i, j);
}
template <int i>
double principal_strain(const ElementTensors& e) {
  return principal(strain(e))[i];
}
inline double pressure(const ElementTensors& e) { return -e.cauchy.trace() / 3; }
inline double max_shear(const ElementTensors& e) {
  const Vec3 s = principal(e.cauchy);
  return (s[2] - s[0]) / 2;
}
}  // namespace fields

inline constexpr std::array<FieldInfo, field_count> field_list{{
    {Field::none, "none", "Tissue", "", "", FieldScale::from_zero, "the tissue itself"},
    {Field::displacement, "displacement", "Displacement", "Displacement", "m", FieldScale::from_zero,
     "distance from the rest position", [](const Vec3& rest, const Vec3& now) { return (now - rest).norm(); }},
    {Field::stretch, "stretch", "Stretch", "Largest stretch", "", FieldScale::about_one, "largest principal stretch",
     nullptr, [](const ElementState<double>& s) { return s.stretch; }},
    {Field::von_mises, "von_mises", "von Mises stress", "von Mises stress", "Pa", FieldScale::from_zero,
     "of the Cauchy stress", nullptr, [](const ElementState<double>& s) { return s.von_mises; }},
    {Field::volume_ratio, "J", "Volume ratio J", "Volume ratio J", "", FieldScale::about_one,
     "volume over that at rest", nullptr, [](const ElementState<double>& s) { return s.J; }},
    {Field::error, "error", "Mesh error", "Mesh error relative to the mean", "%", FieldScale::from_zero,
     "estimated discretisation error, in the energy norm, relative to the body's mean"},
    {Field::displacement_x, "displacement_x", "Displacement, x", "Displacement along x", "m", FieldScale::about_zero,
     "along x", fields::displacement<0>},
    {Field::displacement_y, "displacement_y", "Displacement, y", "Displacement along y", "m", FieldScale::about_zero,
     "along y", fields::displacement<1>},
    {Field::displacement_z, "displacement_z", "Displacement, z", "Displacement along z", "m", FieldScale::about_zero,
     "along z", fields::displacement<2>},
    {Field::stress_max, "stress_max", "Largest principal stress", "Largest principal stress", "Pa",
     FieldScale::about_zero, "of the Cauchy stress: tension is positive", nullptr, nullptr,
     fields::principal_stress<2>},
    {Field::stress_mid, "stress_mid", "Middle principal stress", "Middle principal stress", "Pa",
     FieldScale::about_zero, "of the Cauchy stress, between the largest and the smallest", nullptr, nullptr,
     fields::principal_stress<1>},
    {Field::stress_min, "stress_min", "Smallest principal stress", "Smallest principal stress", "Pa",
     FieldScale::about_zero, "of the Cauchy stress: compression is negative", nullptr, nullptr,
     fields::principal_stress<0>},
    {Field::pressure, "pressure", "Pressure", "Pressure", "Pa", FieldScale::about_zero,
     "minus the mean of the principal Cauchy stresses", nullptr, nullptr, fields::pressure},
    {Field::max_shear, "max_shear", "Largest shear stress", "Largest shear stress", "Pa", FieldScale::from_zero,
     "half the difference of the largest and smallest principal Cauchy stress", nullptr, nullptr, fields::max_shear},
    {Field::stress_xx, "stress_xx", "Stress xx", "Cauchy stress xx", "Pa", FieldScale::about_zero, "Cauchy stress",
     nullptr, nullptr, fields::stress<0, 0>},
    {Field::stress_yy, "stress_yy", "Stress yy", "Cauchy stress yy", "Pa", FieldScale::about_zero, "Cauchy stress",
     nullptr, nullptr, fields::stress<1, 1>},
    {Field::stress_zz, "stress_zz", "Stress zz", "Cauchy stress zz", "Pa", FieldScale::about_zero, "Cauchy stress",
     nullptr, nullptr, fields::stress<2, 2>},
    {Field::stress_xy, "stress_xy", "Stress xy", "Cauchy stress xy", "Pa", FieldScale::about_zero, "Cauchy stress",
     nullptr, nullptr, fields::stress<0, 1>},
    {Field::stress_yz, "stress_yz", "Stress yz", "Cauchy stress yz", "Pa", FieldScale::about_zero, "Cauchy stress",
     nullptr, nullptr, fields::stress<1, 2>},
    {Field::stress_zx, "stress_zx", "Stress zx", "Cauchy stress zx", "Pa", FieldScale::about_zero, "Cauchy stress",
     nullptr, nullptr, fields::stress<2, 0>},
    {Field::strain_max, "strain_max", "Largest principal strain", "Largest principal strain", "",
     FieldScale::about_zero, "of the Green–Lagrange strain", nullptr, nullptr, fields::principal_strain<2>},
    {Field::strain_mid, "strain_mid", "Middle principal strain", "Middle principal strain", "",
     FieldScale::about_zero, "of the Green–Lagrange strain, between the largest and the smallest", nullptr, nullptr,
     fields::principal_strain<1>},
    {Field::strain_min, "strain_min", "Smallest principal strain", "Smallest principal strain", "",
     FieldScale::about_zero, "of the Green–Lagrange strain", nullptr, nullptr, fields::principal_strain<0>},
    {Field::strain_xx, "strain_xx", "Strain xx", "Green–Lagrange strain xx", "", FieldScale::about_zero,
     "Green–Lagrange strain", nullptr, nullptr, fields::strain_component<0, 0>},
    {Field::strain_yy, "strain_yy", "Strain yy", "Green–Lagrange strain yy", "", FieldScale::about_zero,
     "Green–Lagrange strain", nullptr, nullptr, fields::strain_component<1, 1>},
    {Field::strain_zz, "strain_zz", "Strain zz", "Green–Lagrange strain zz", "", FieldScale::about_zero,
     "Green–Lagrange strain", nullptr, nullptr, fields::strain_component<2, 2>},
    {Field::strain_xy, "strain_xy", "Strain xy", "Green–Lagrange strain xy", "", FieldScale::about_zero,
     "Green–Lagrange strain", nullptr, nullptr, fields::strain_component<0, 1>},
    {Field::strain_yz, "strain_yz", "Strain yz", "Green–Lagrange strain yz", "", FieldScale::about_zero,
     "Green–Lagrange strain", nullptr, nullptr, fields::strain_component<1, 2>},
    {Field::strain_zx, "strain_zx", "Strain zx", "Green–Lagrange strain zx", "", FieldScale::about_zero,
     "Green–Lagrange strain", nullptr, nullptr, fields::strain_component<2, 0>},
}};

static_assert(
    [] {
      for (std::size_t k = 0; k < field_count; ++k)
        if (field_list[k].field != static_cast<Field>(k) || field_list[k].name.empty()) return false;
      return true;
    }(),
    "a field has no row in field_list, or the rows are not in the order of the enum");

constexpr const FieldInfo& info(Field field) { return field_list[static_cast<std::size_t>(field)]; }

/// Names in scene files, in the order of the enum.
inline constexpr auto field_names = [] {
  std::array<std::string_view, field_count> names;
  for (std::size_t k = 0; k < field_count; ++k) names[k] = field_list[k].name;
  return names;
}();

}  // namespace heml
