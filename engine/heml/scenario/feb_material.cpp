#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/materials/energy_law.hpp>
#include <heml/mesh/readers.hpp>
#include <heml/mesh/xml_values.hpp>
#include <heml/scenario/feb_material.hpp>
#include <heml/scenario/young_poisson.hpp>
#include <map>

namespace heml {
namespace {

constexpr int max_feb_terms = 6;

/// The numbers of a material by name; those in `taken` have been used.
class FebParameters {
 public:
  FebParameters(const XmlElement& material, FebFindings& findings) : material_(material), findings_(findings) {
    for (const XmlElement child : material.children()) children_.emplace(std::string(child.name()), child);
  }

  /// fallback: what FEBio takes where the file gives none; none: it has to be given.
  double get(const std::string& name, std::optional<double> fallback = std::nullopt) {
    const auto child = children_.find(name);
    if (child == children_.end()) {
      if (!fallback) refuse(fmt::format("has no <{}>", name));
      return fallback.value_or(1);
    }
    const XmlElement value = child->second;
    children_.erase(child);
    const std::optional<double> number = feb_number(value, findings_);
    if (!number) valid_ = false;
    if (number && value.attribute("lc")) refuse(fmt::format("changes <{}> over time", name));
    return number.value_or(fallback.value_or(1));
  }

  /// U(J) of an uncoupled material.
  VolumeTerm volume_term() {
    const auto child = children_.find("pressure_model");
    if (child == children_.end()) return VolumeTerm::logarithmic;
    const std::string model(child->second.text());
    children_.erase(child);
    if (model == "default" || model == "0") return VolumeTerm::logarithmic;
    if (model == "NIKE3D" || model == "1" || model == "Abaqus (GOH)" || model == "3") return VolumeTerm::simo_taylor;
    if (model == "Abaqus" || model == "2") return VolumeTerm::quadratic;
    refuse(fmt::format("has the pressure_model '{}'", plain_name(model)));
    return VolumeTerm::logarithmic;
  }

  /// Axes have no effect on an isotropic law; everything else that is left would have one.
  void finish() {
    for (const auto& [name, child] : children_)
      if (name == "mat_axis" || name == "fiber" || name == "density_scale" || name == "active_contraction_axis")
        findings_.note(child, fmt::format("<{}> has no effect on an isotropic law", plain_name(name)));
      else
        refuse(fmt::format("has <{}>", plain_name(name)));
  }

  void refuse(const std::string& problem) {
    findings_.refuse(material_, feb_name(material_) + " " + problem);
    valid_ = false;
  }
  bool valid() const { return valid_; }

 private:
  XmlElement material_;
  FebFindings& findings_;
  std::map<std::string, XmlElement> children_;
  bool valid_ = true;
};

Material with_lame(const char* law, FebParameters& given, const FebUnits& units) {
  const double young = units.stress() * given.get("E"), poisson = given.get("v");
  if (const std::string problem = young_problem(young); !problem.empty()) given.refuse("has E: " + problem);
  if (const std::string problem = poisson_problem(poisson); !problem.empty()) given.refuse("has v: " + problem);
  if (!given.valid()) return {};
  const LameParameters lame = lame_parameters(young, poisson);
  return {law, {lame.lambda, lame.mu}};
}

Material uncoupled(const char* law, std::vector<double> parameters, FebParameters& given, const FebUnits& units) {
  Material material{law, std::move(parameters)};
  material.parameters.push_back(units.stress() * given.get("k"));
  material.volume_term = given.volume_term();
  return material;
}

struct FebTerm {
  int number;
  double c, m;
};

/// Terms of Ogden's laws; those of strength 0 are left out.
std::vector<FebTerm> ogden_terms(FebParameters& given, const FebUnits& units) {
  std::vector<FebTerm> terms;
  for (int i = 1; i <= max_feb_terms; ++i) {
    const double c = units.stress() * given.get(fmt::format("c{}", i), 0), m = given.get(fmt::format("m{}", i), 1);
    if (m == 0) given.refuse(fmt::format("has m{} = 0", i));
    if (c != 0) terms.push_back({i, c, m});
  }
  if (terms.empty()) given.refuse("has no term");
  return terms;
}

Material ogden(FebParameters& given, const FebUnits& units) {
  std::vector<double> mu, alpha;
  for (const FebTerm& term : ogden_terms(given, units)) {
    mu.push_back(term.c / term.m);
    alpha.push_back(term.m);
  }
  mu.insert(mu.end(), alpha.begin(), alpha.end());
  return uncoupled("ogden", std::move(mu), given, units);
}

Material yeoh(FebParameters& given, const FebUnits& units) {
  std::vector<double> c;
  for (int i = 1; i <= max_feb_terms; ++i) {
    const double value = units.stress() * given.get(fmt::format("c{}", i), 0);
    if (i <= 3) c.push_back(value);
    if (i > 3 && value != 0) given.refuse(fmt::format("has c{}: heml's law has three terms", i));
  }
  return uncoupled("yeoh", std::move(c), given, units);
}

Material coupled_mooney_rivlin(FebParameters& given, const FebUnits& units) {
  const double s = units.stress();
  return {energy_definition("c1*(I1-3) + c2*(I2-3) - 2*(c1+2*c2)*log(J) + k/2*log(J)^2", {"c1", "c2", "k"}),
          {s * given.get("c1"), s * given.get("c2", 0), s * given.get("k")}};
}

Material ogden_unconstrained(FebParameters& given, const FebUnits& units) {
  std::string text = "cp/2*(J-1)^2";
  std::vector<std::string> names{"cp"};
  std::vector<double> values{units.stress() * given.get("cp")};
  for (const FebTerm& term : ogden_terms(given, units)) {
    text += fmt::format(" + c{0}/m{0}^2*(l1^m{0}+l2^m{0}+l3^m{0}-3-m{0}*log(J))", term.number);
    names.insert(names.end(), {fmt::format("c{}", term.number), fmt::format("m{}", term.number)});
    values.insert(values.end(), {term.c, term.m});
  }
  return {energy_definition(text, names), std::move(values)};
}

/// W = (λ+2μ)/4β (exp Q − 1), Q = β ((2μ−λ) (I1−3) + λ (I2−3))/(λ+2μ) − 2 β ln J.
Material holmes_mow(FebParameters& given, const FebUnits& units) {
  const Material lame = with_lame("stvk", given, units);
  const double beta = given.get("beta");
  if (!(beta > 0)) given.refuse("has beta: has to be greater than 0 (at 0 it has no energy)");
  if (!given.valid()) return {};
  return {energy_definition("(lam+2*mu)/(4*beta)*(exp(beta*((2*mu-lam)*(I1-3) + lam*(I2-3))/(lam+2*mu) - "
                            "2*beta*log(J)) - 1)",
                            {"lam", "mu", "beta"}),
          {lame.parameters[0], lame.parameters[1], beta}};
}

struct FebLaw {
  std::string_view type;
  Material (*convert)(FebParameters& given, const FebUnits& units);
};

constexpr FebLaw feb_laws[] = {
    {"neo-Hookean", [](FebParameters& given, const FebUnits& units) { return with_lame("neo_hookean", given, units); }},
    {"isotropic elastic", [](FebParameters& given, const FebUnits& units) { return with_lame("stvk", given, units); }},
    {"incomp neo-Hookean",
     [](FebParameters& given, const FebUnits& units) {
       return uncoupled("neo_hookean_iso", {units.stress() * given.get("G") / 2}, given, units);
     }},
    {"Mooney-Rivlin",
     [](FebParameters& given, const FebUnits& units) {
       const double s = units.stress();
       return uncoupled("mooney_rivlin", {s * given.get("c1"), s * given.get("c2", 0)}, given, units);
     }},
    {"Veronda-Westmann",
     [](FebParameters& given, const FebUnits& units) {
       return uncoupled("veronda_westmann", {units.stress() * given.get("c1"), given.get("c2")}, given, units);
     }},
    {"Yeoh", yeoh},
    {"Gent",
     [](FebParameters& given, const FebUnits& units) {
       return uncoupled("gent", {units.stress() * given.get("G"), given.get("Jm")}, given, units);
     }},
    {"Ogden", ogden},
    {"coupled Mooney-Rivlin", coupled_mooney_rivlin},
    {"Ogden unconstrained", ogden_unconstrained},
    {"Holmes-Mow", holmes_mow},
};

}  // namespace

std::optional<double> feb_number(const XmlElement& value, FebFindings& findings) {
  const std::string type = value.attribute("type").value_or("const");
  if (type == "const") return number_in(value, value.text(), feb_tag(value));
  findings.refuse(value, fmt::format("{} varies from place to place", feb_name(value)));
  return std::nullopt;
}

std::optional<Material> feb_material(const XmlElement& material, const FebUnits& units, FebFindings& findings) {
  const std::string type = material.attribute_or_empty("type");
  const auto law =
      std::find_if(std::begin(feb_laws), std::end(feb_laws), [&](const FebLaw& known) { return known.type == type; });
  if (law == std::end(feb_laws)) {
    std::vector<std::string_view> known;
    for (const FebLaw& each : feb_laws) known.push_back(each.type);
    findings.refuse(material, fmt::format("{} is no law that is known exactly (known: {})", feb_name(material),
                                          fmt::join(known, ", ")));
    return std::nullopt;
  }
  FebParameters given(material, findings);
  Material result = law->convert(given, units);
  result.density = units.density() * given.get("density", 1);
  given.finish();
  if (!given.valid()) return std::nullopt;
  if (const auto problem = material_problem(result)) {
    given.refuse(
        fmt::format("becomes the law {}, whose {} {}", find_law(result.law)->name, problem->first, problem->second));
    return std::nullopt;
  }
  return result;
}

}  // namespace heml
