// The reference page of laws and tissue presets, from the register of laws and assets/materials.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <app/commands/markdown.hpp>
#include <app/commands/reference.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/scene_keys.hpp>

namespace heml {
namespace {

const char* range_text(ParameterRange range) {
  switch (range) {
    case ParameterRange::any:
      return "any";
    case ParameterRange::positive:
      return "> 0";
    case ParameterRange::not_negative:
      return "≥ 0";
    case ParameterRange::not_zero:
      return "≠ 0";
  }
  return "";
}

const char* kind_text(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::plain:
      return "";
    case ParameterKind::list:
      return "; a list, all lists of the law of one length";
    case ParameterKind::exponent:
      return "; exponent";
    case ParameterKind::limit:
      return "; limit of stretch: the law ends there";
  }
  return "";
}

/// Keys of `materials[]` that some laws take and others do not.
std::string particular_keys_of(const LawInfo& law) {
  std::vector<std::string> taken;
  for (const KeyInfo& key : keys_of("materials[]")) {
    bool is_general = true;
    for (const LawInfo& other : laws()) is_general &= takes_key(other, key.name);
    if (!is_general && takes_key(law, key.name)) taken.push_back(fmt::format("`{}`", key.name));
  }
  return taken.empty() ? "none" : fmt::format("{}", fmt::join(taken, ", "));
}

std::string features_of(const LawInfo& law) {
  std::vector<std::string> features;
  if (!law.is_continuum) features.push_back("forces along mesh edges, no continuum");
  if (law.is_principal) features.push_back("evaluated by principal stretches");
  if (law.has_volume_term) features.push_back("separate volume term: takes `\"element\": \"nodal_pressure\"`");
  if (law.has_fibre) features.push_back("transversely isotropic");
  if (!law.is_stress_free) features.push_back("not free of stress at rest");
  return features.empty() ? "" : fmt::format("{}", fmt::join(features, "; "));
}

/// What laws of principal stretches lose; measured by the rows it names.
constexpr const char* digits_of_stretches =
    "Stretches are roots of eigenvalues of C, so the smallest loses digits with the square of its ratio to the "
    "largest: W differs by\n"
    "5e-9 of itself at a ratio of 1e-4, by 3e-5 at 1e-6, between two states that are the same but for a rotation: "
    "`heml probe` of\n"
    "`{\"law\": \"ogden\", \"mu\": [-1000], \"alpha\": [-2], \"kappa\": 1e5}` at the rows "
    "`1e-4,0,0,0,1,0,0,0,1` and\n"
    "`6e-5,8e-5,0,-0.8,0.6,0,0,0,1`; likewise with 1e-6, 6e-7 and 8e-7.\n\n";

std::string law_section(const LawInfo& law) {
  std::string text = fmt::format("## {}\n\n{}.\n\n", law.name, law.title);
  MarkdownTable facts({"", ""});
  facts.add({"W", std::string(law.formula)});
  if (const std::string features = features_of(law); !features.empty()) facts.add({"features", features});
  facts.add({"further keys", particular_keys_of(law)});
  facts.add({"cost of forces",
             fmt::format("{} ns a tetrahedron in double, {} in float", law.cost.in_double, law.cost.in_float)});
  facts.add({"source", std::string(law.source)});
  MarkdownTable parameters({"parameter", "symbol", "unit", "range", "in the panel first", "meaning"});
  for (const ParameterInfo& info : law.parameters)
    parameters.add({fmt::format("`{}`", info.name), std::string(info.symbol), std::string(info.unit),
                    range_text(info.range), fmt::format("{}", info.initial_value),
                    std::string(info.meaning) + kind_text(info.kind)});
  text += facts.text() + parameters.text();
  return law.is_principal ? text + digits_of_stretches : text;
}

std::string preset_section(const Preset& preset) {
  const LawInfo& law = *find_law(preset.material.law);
  std::string values;
  const std::vector<ParameterSlot> slots = parameter_slots(preset.material, law);
  for (std::size_t i = 0; i < slots.size(); ++i)
    values += fmt::format("{}`{}` {:.6g}{}{}", i ? ", " : "", slots[i].key(), preset.material.parameters[i],
                          slots[i].info->unit.empty() ? "" : " ", slots[i].info->unit);
  std::string text = fmt::format("### {}\n\n{}.\n\n", preset.name, preset.title);
  MarkdownTable facts({"", ""});
  facts.add({"tissue", preset.species.empty() ? preset.tissue : preset.tissue + ", " + preset.species});
  facts.add({"law", fmt::format("[`{0}`](#{1}): {2}", law.name, anchor(law.name), values)});
  facts.add({"at rest", fmt::format("shear modulus {:.6g} Pa", preset.shear_modulus)});
  facts.add({"measured in", preset.test});
  facts.add({"stretch", preset.stretch_range
                            ? fmt::format("{:.4g} to {:.4g}", preset.stretch_range->low, preset.stretch_range->high)
                            : std::string("range not known")});
  if (!preset.ours.empty()) facts.add({"chosen here", fmt::format("{}", fmt::join(preset.ours, ", "))});
  facts.add({"source", to_text(preset.source)});
  facts.add({"numbers compared with the source", preset.verified ? "yes" : "no"});
  return text + facts.text();
}

/// The section of laws by expression, which are no entry of the register.
std::string energy_section() {
  std::string text =
      "## energy\n\n"
      "A law of one's own: W as an expression, without C++.\n\n"
      "```json\n"
      "{ \"law\": \"energy\", \"expression\": \"C1*(I1b-3) + kappa/2*(J-1)^2\", \"parameters\": { \"C1\": 1500, "
      "\"kappa\": 1e5 } }\n"
      "```\n\n";
  MarkdownTable facts({"", ""});
  facts.add({"names", fmt::format("`{}`", fmt::join(energy_variables(), "`, `"))});
  facts.add({"functions", fmt::format("`{}`; `log` is the natural one", fmt::join(energy_functions(), "`, `"))});
  facts.add(
      {"operators", "`+ - * /` and `^`, which is right-associative and binds tighter than a sign: -x^2 is -(x^2)"});
  facts.add({"`parameters`", "a number for each other name; every one must occur in the expression"});
  facts.add({"`fibre`", "direction a0 of `I4`, `I4b`; required by them"});
  facts.add({"range", "J > 0, and wherever W and its derivatives are finite"});
  facts.add({"further keys", "`active_stress`, `viscosity`, `bulk_viscosity`"});
  return text + facts.text() +
         "I1, I2, I3 are the invariants of C, l1 ≥ l2 ≥ l3 the principal stretches; b: of J^(−1/3) F. First and second "
         "derivatives\n"
         "are exact (differentiated forward, twice) and run on packs of elements. Stretches lose digits as those of "
         "[`ogden`](#ogden)\n"
         "do. W must be symmetric in stretches "
         "that "
         "coincide.\n"
         "Of `min`, `max` and `abs` the derivative is that of the branch taken. An error names its column. A stress at "
         "rest and moduli\n"
         "at rest that are not positive are warned of. There is no continuation and no separate volume term: "
         "`continuation` true,\n"
         "`nodal_pressure`, `relaxation` and `plasticity` are refused. `assets/scenes/energy_law.json` is an "
         "example.\n\n";
}

}  // namespace

std::string laws_page() {
  std::string text =
      "# Laws\n\n"
      "Written by `heml reference` from the register of laws (`engine/heml/materials/law_list.hpp`) and the presets "
      "of\n"
      "`assets/materials`; `heml materials` prints it with more of the presets. Adding one: "
      "[adding](adding.md#a-law).\n\n"
      "W is the energy per unit rest volume; C = FᵀF with invariants I1, I2; J = det F, signed; bars: of J^(−1/3) F; "
      "I4 = a0·C\n"
      "a0 with the fibre's direction a0 at rest. An entry of a scene's `materials` gives a law, its parameters as "
      "keys,\n"
      "and [keys that all entries take](../../app/docs/scene-format.md#materials). Every parameter must be given. One "
      "that is\n"
      "no list may be `{\"field\": NAME}`, a field of the mesh file. The cost is that of the fixed model by which "
      "`auto`\n"
      "chooses, measured on one core of an AMD EPYC with AVX2.\n\n";
  MarkdownTable list({"law", "title", "parameters"});
  for (const LawInfo& law : laws()) {
    std::vector<std::string> names;
    for (const ParameterInfo& info : law.parameters) names.push_back(fmt::format("`{}`", info.name));
    list.add({fmt::format("[`{}`](#{})", law.name, anchor(law.name)), std::string(law.title),
              fmt::format("{}{}", fmt::join(names, ", "),
                          law.takes_young_poisson ? "; or `young`, `poisson` (Pa, −)" : "")});
  }
  list.add({"[`energy`](#energy)", "An expression of one's own", "`expression`, `parameters`"});
  text += list.text();
  for (const LawInfo& law : laws()) text += law_section(law);
  text += energy_section();
  text += "## Presets\n\n`\"preset\": NAME` in an entry of `materials` stands for law and parameters.\n\n";
  for (const Preset& preset : presets()) text += preset_section(preset);
  text.pop_back();
  return text;
}

}  // namespace heml
