// `heml materials`: lists laws and tissue presets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <app/commands/commands.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/presets.hpp>

namespace heml {
namespace {

constexpr std::size_t line_width = 100, indent = 4, name_width = 14;

/// Terminal columns of a text: code points without combining accents.
std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool accent =
        byte == 0xcc || (byte == 0xcd && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xb0);
    count += (byte & 0xc0) != 0x80 && !accent;
  }
  return count;
}

std::string padded(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(width - std::min(width, columns(text)), ' ');
}

/// "    name          text that goes on
///                   under itself"
void print_entry(std::string_view name, std::string_view text, std::size_t width = name_width) {
  const std::size_t left = indent + width;
  std::string line = std::string(indent, ' ') + padded(name, width);
  bool empty = true;
  const auto end_line = [&] {
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
    line.assign(left, ' ');
    empty = true;
  };
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (!empty && columns(line) + 1 + columns(word) > line_width) end_line();
    if (!empty) line += ' ';
    line += word;
    empty = false;
  }
  end_line();
}

void print_law(const LawInfo& law) {
  fmt::print("\n  {}: {}\n", law.name, law.title);
  print_entry("W", law.formula);
  for (const ParameterInfo& info : law.parameters) {
    print_entry(fmt::format("{:<10}{}", fmt::format("{}{}", info.name, info.is_list() ? "[]" : ""), info.unit),
                info.meaning);
  }
  if (law.takes_young_poisson) print_entry("or", "young (Pa) and poisson in place of lambda and mu");
  if (law.has_fibre) print_entry("fibre", "[x, y, z]: direction of the fibres at rest");
  print_entry("source", law.source);
}

std::string values_text(const Material& material, const LawInfo& law) {
  std::string text;
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  for (std::size_t i = 0; i < slots.size(); ++i)
    text += fmt::format("{}{} {:.6g}{}{}", i ? ", " : "", slots[i].key(), material.parameters[i],
                        slots[i].info->unit.empty() ? "" : " ", slots[i].info->unit);
  return text;
}

void print_preset(const Preset& preset) {
  const LawInfo& law = *find_law(preset.material.law);
  fmt::print("\n  {}: {}\n", preset.name, preset.title);
  print_entry("tissue", preset.species.empty() ? preset.tissue : preset.tissue + ", " + preset.species);
  print_entry("law", fmt::format("{}: {}", law.name, values_text(preset.material, law)));
  print_entry("at rest", fmt::format("shear modulus {:.6g} Pa", preset.shear_modulus));
  std::vector<std::string> published;
  for (const auto& [name, value] : preset.published) published.push_back(fmt::format("{} {:.6g}", name, value));
  print_entry("published", fmt::format("{} (SI units)", fmt::join(published, ", ")));
  print_entry("convention", preset.convention);
  if (!preset.ours.empty()) print_entry("our choice", fmt::format("{}", fmt::join(preset.ours, ", ")));
  print_entry("measured in", preset.test);
  print_entry("stretch", preset.stretch_range
                             ? fmt::format("{:.4g} to {:.4g}", preset.stretch_range->low, preset.stretch_range->high)
                             : std::string("range not known"));
  print_entry("source", to_text(preset.source));
  print_entry("consulted", preset.seen);
  print_entry("verified", preset.verified ? "the values were compared with the source"
                                          : "no: the values were not compared with the source");
  if (!preset.note.empty()) print_entry("note", preset.note);
}

Json law_json(const LawInfo& law) {
  Json parameters = Json::array();
  for (const ParameterInfo& info : law.parameters)
    parameters.push_back({{"name", info.name},
                          {"symbol", info.symbol},
                          {"unit", info.unit},
                          {"meaning", info.meaning},
                          {"list", info.is_list()}});
  return {{"name", law.name},
          {"title", law.title},
          {"formula", law.formula},
          {"parameters", parameters},
          {"source", law.source},
          {"takes_young_poisson", law.takes_young_poisson},
          {"has_volume_term", law.has_volume_term},
          {"has_fibre", law.has_fibre},
          {"is_continuum", law.is_continuum}};
}

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json preset_json(const Preset& preset) {
  Json published = Json::object();
  for (const auto& [name, value] : preset.published) published[name] = value;
  const SmallStrainModuli rest = small_strain_moduli(preset.material);
  const Citation& from = preset.source;
  return {
      {"name", preset.name},
      {"title", preset.title},
      {"tissue", preset.tissue},
      {"species", text_or_null(preset.species)},
      {"material", material_json({std::nullopt, preset.material})},
      {"published", published},
      {"convention", preset.convention},
      {"ours", preset.ours},
      {"shear_modulus", rest.shear},
      {"bulk_modulus", rest.bulk},
      {"test", preset.test},
      {"stretch_range", preset.stretch_range ? Json{preset.stretch_range->low, preset.stretch_range->high} : Json()},
      {"source",
       {{"authors", from.authors},
        {"year", from.year ? Json(from.year) : Json()},
        {"title", text_or_null(from.title)},
        {"published_in", text_or_null(from.published_in)},
        {"doi", text_or_null(from.doi)},
        {"url", text_or_null(from.url)},
        {"place", text_or_null(from.place)}}},
      {"seen", preset.seen},
      {"note", text_or_null(preset.note)},
      {"verified", preset.verified}};
}

constexpr std::string_view energy_meaning =
    "A law of one's own: W (Pa) as an expression of invariants, stretches and parameters";

void print_energy() {
  fmt::print("\n  energy: {}\n", energy_meaning);
  print_entry("expression", "text, e.g. \"C1*(I1b-3) + kappa/2*(J-1)^2\"");
  print_entry("parameters", "object: a number for each name, e.g. {\"C1\": 1500, \"kappa\": 1e5}");
  print_entry("fibre", "[x, y, z]: direction of I4 and I4b at rest");
  print_entry("names", fmt::format("{}", fmt::join(energy_variables(), ", ")));
  print_entry("functions", fmt::format("{}", fmt::join(energy_functions(), ", ")));
}

Json energy_json() {
  return {{"law", "energy"},
          {"meaning", energy_meaning},
          {"variables", energy_variables()},
          {"functions", energy_functions()}};
}

void print_text() {
  fmt::print("Laws: energy W per unit rest volume; C = FᵀF, J = det F, bars: of J^(−1/3) F\n");
  for (const LawInfo& law : laws()) print_law(law);
  print_energy();
  fmt::print("\n\nTissues: \"preset\": NAME in a scene's `materials`\n");
  for (const Preset& preset : presets()) print_preset(preset);
}

}  // namespace

int materials(const MaterialsArguments& arguments) {
  if (!arguments.json) {
    print_text();
    return exit_done;
  }
  Json json{{"laws", Json::array()}, {"presets", Json::array()}};
  for (const LawInfo& law : laws()) json["laws"].push_back(law_json(law));
  json["expressions"] = energy_json();
  for (const Preset& preset : presets()) json["presets"].push_back(preset_json(preset));
  fmt::print("{}\n", json_text(json, "", true));
  return exit_done;
}

}  // namespace heml
