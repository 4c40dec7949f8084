#pragma once
// Materials by expression for tests, and every law that has one.
#include <heml/materials/energy_law.hpp>
#include <string>
#include <utility>
#include <vector>

namespace heml::test {

inline Material energy_material(const std::string& text,
                                const std::vector<std::pair<std::string, double>>& parameters = {},
                                const Vec3& fibre = Vec3::Zero()) {
  std::vector<std::string> names;
  Material material;
  for (const auto& [name, value] : parameters) {
    names.push_back(name);
    material.parameters.push_back(value);
  }
  material.law = energy_definition(text, names);
  material.fibre = fibre;
  return material;
}

/// A law of its own type and the same as an expression.
struct SameEnergy {
  Material law, expression;
};
inline std::vector<SameEnergy> same_energies() {
  const Vec3 fibre = Vec3(1, 2, -2) / 3;
  return {
      {{"neo_hookean", {4e3, 1e3}},
       energy_material("mu/2*(I1-3) - mu*log(J) + lambda/2*log(J)^2", {{"mu", 1e3}, {"lambda", 4e3}})},
      {{"neo_hookean_iso", {500, 5e4}}, energy_material("K1*(I1b-3) + kappa/2*(J-1)^2", {{"K1", 500}, {"kappa", 5e4}})},
      {{"mooney_rivlin", {400, 100, 5e4}},
       energy_material("K1*(I1b-3) + K2*(I2b-3) + kappa/2*(J-1)^2", {{"K1", 400}, {"K2", 100}, {"kappa", 5e4}})},
      {{"yeoh", {500, -50, 80, 5e4}},
       energy_material("C10*(I1b-3) + C20*(I1b-3)^2 + C30*pow(I1b-3, 3) + kappa/2*(J-1)^2",
                       {{"C10", 500}, {"C20", -50}, {"C30", 80}, {"kappa", 5e4}})},
      {{"fung_demiray", {1e3, 0.8, 5e4}},
       energy_material("mu/(2*gamma)*(exp(gamma*(I1b-3)) - 1) + kappa/2*(J-1)^2",
                       {{"mu", 1e3}, {"gamma", 0.8}, {"kappa", 5e4}})},
      {{"ogden", {300, -200, 3, -4, 5e4}},
       energy_material("m1/a1*(l1b^a1+l2b^a1+l3b^a1-3) + m2/a2*(l1b^a2+l2b^a2+l3b^a2-3) + kappa/2*(J-1)^2",
                       {{"m1", 300}, {"m2", -200}, {"a1", 3}, {"a2", -4}, {"kappa", 5e4}})},
      {{"ogden", {350, 2.4, 5e4}},
       energy_material("m/a*(l1b^a+l2b^a+l3b^a-3) + kappa/2*(J-1)^2", {{"m", 350}, {"a", 2.4}, {"kappa", 5e4}})},
      {{"hgo", {500, 5e4, 800, 2}, 1000, fibre},
       energy_material("K1*(I1b-3) + kappa/2*(J-1)^2 + k1/(2*k2)*(exp(k2*max(I4b-1, 0)^2)-1)",
                       {{"K1", 500}, {"kappa", 5e4}, {"k1", 800}, {"k2", 2}}, fibre)},
      {{"hgo", {500, 5e4, 800, 2}, 1000, fibre},  // of stretches, with a fibre
       energy_material("K1*(l1b^2+l2b^2+l3b^2-3) + kappa/2*(J-1)^2 + k1/(2*k2)*(exp(k2*max(I4b-1, 0)^2)-1)",
                       {{"K1", 500}, {"kappa", 5e4}, {"k1", 800}, {"k2", 2}}, fibre)},
  };
}

}  // namespace heml::test
