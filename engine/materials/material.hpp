#pragma once
// A material as people write it: the name of a law, its parameters, a density. The engine turns it into a law's struct
// once, when a body is built or the law is switched (world/make_world.cpp).
#include <heml/materials/law.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heml {

struct Material {
  std::string law = "stvk";        ///< one of laws()
  std::vector<double> parameters;  ///< in the order of LawInfo::parameters, SI units
  double density = 1000.0;         ///< kg/m³
};

/// What the program knows of a law before it runs it.
struct LawInfo {
  std::string_view name;                      ///< "stvk"
  std::string_view title;                     ///< "Saint Venant–Kirchhoff"
  std::span<const ParameterInfo> parameters;  ///< what Material::parameters holds
  bool takes_young_poisson;                   ///< `young`, `poisson` may stand for `lambda`, `mu` in a scene
};

/// Every law this build can run, in the order the panel lists them.
std::span<const LawInfo> laws();

/// The law of that name; nullptr when there is none.
const LawInfo* find_law(std::string_view name);

/// What is wrong with the parameters or the density: (key, problem), e.g. ("mu", "must be greater than 0, is -3").
/// Empty when nothing is.
std::optional<std::pair<std::string, std::string>> material_problem(const Material& material);

/// Lamé parameters from engineering constants: λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)).
struct Lame {
  double lambda, mu;  ///< Pa
};
Lame lame_from(double young, double poisson);

/// And back: E = μ(3λ+2μ)/(λ+μ), ν = λ/(2(λ+μ)).
struct Engineering {
  double young;    ///< Pa
  double poisson;  ///< -
};
Engineering engineering_from(const Lame& lame);

}  // namespace heml
