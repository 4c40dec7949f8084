#include <fmt/format.h>

#include <algorithm>
#include <app/panel/icons.hpp>
#include <app/panel/mesh_section.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/tissue_choice.hpp>
#include <cmath>
#include <heml/scenario/body_shape.hpp>
#include <heml/scenario/presets.hpp>
#include <set>

namespace heml::panel {
namespace {

constexpr double min_length = 0.1, max_length = 200;         // cm, of a body
constexpr int min_tets = 100, max_tets = 100'000;            // that are offered
constexpr double fractions[] = {0.125, 0.25, 0.5, 2, 4, 8};  // of the number that was read
constexpr const char* reopens = "Another choice opens the mesh again; Ctrl+Z goes back.";

template <class Value>
struct Offer {
  std::string name, hint;
  Value value;
  bool is_now;
};

/// A button that goes back to the guess, in the room that it leaves at the end of a row.
class BackToGuess {
 public:
  BackToGuess(Rows& rows, bool is_given) : rows_(rows), is_given_(is_given) {
    if (is_given_) rows_.leave_room(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x);
  }
  bool pressed(const std::string& name) {
    if (!is_given_) return false;
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    return rows_.icon_button({name + " as guessed", "Opens the mesh again with what is guessed for it."},
                             ImGui::GetFrameHeight(), false, draw_undo);
  }

 private:
  Rows& rows_;
  bool is_given_;
};

/// True when another value was chosen; `given` is empty where it is to be guessed again.
template <class Value>
bool choose(Rows& rows, const Label& label, const std::vector<Offer<Value>>& offers, std::optional<Value>& given) {
  std::vector<std::string> names, hints;
  int index = -1;
  for (const Offer<Value>& offer : offers) {
    if (offer.is_now) index = static_cast<int>(names.size());
    names.push_back(offer.name);
    hints.push_back(offer.hint);
  }
  BackToGuess back(rows, given.has_value());
  const bool changed = rows.choice(label, index, names, hints);
  if (changed) given = offers[static_cast<std::size_t>(index)].value;
  if (!back.pressed(label.text)) return changed;
  given.reset();
  return true;
}

std::vector<Offer<LengthUnit>> unit_offers(const BareMeshChoices& chosen) {
  std::vector<Offer<LengthUnit>> offers;
  const double length = chosen.length / chosen.scale;  // in the file
  bool is_offered = false;
  for (const LengthUnit& unit : plausible_units(length)) {
    const std::string metres = fmt::format("{:.3g} m", unit.scale * length);
    const bool is_same_scale = std::abs(unit.scale - chosen.scale) <= 1e-9 * chosen.scale;
    const bool is_now = unit.name == chosen.unit && is_same_scale;
    is_offered |= is_now;
    // The closed choice has no room for the length, which stands below.
    offers.push_back({unit.name.empty() ? "scaled to " + metres
                      : is_now          ? unit.name
                                        : unit.name + ", " + metres,
                      "Makes the body " + metres + " long.", unit, is_now});
  }
  if (!is_offered) {
    const std::string name = chosen.unit.empty() ? "by its length" : chosen.unit;
    offers.push_back({name, "Scaled to the length that was typed.", {chosen.unit, chosen.scale}, true});
  }
  return offers;
}

std::vector<Offer<UpAxis>> up_offers(UpAxis now) {
  std::vector<Offer<UpAxis>> offers;
  for (const UpAxis axis : up_axes) offers.push_back({info_of(axis).name, "", axis, axis == now});
  return offers;
}

Offer<SupportKind> support_offer(SupportKind kind, bool is_now) {
  switch (kind) {
    case SupportKind::underside:
      return {"underside fixed", "Rests on its lowest part, which is fixed.", kind, is_now};
    case SupportKind::top:
      return {"top fixed", "Hangs from its highest part, which is fixed.", kind, is_now};
    case SupportKind::table:
      return {"on a table", "Lies loose on a table with friction.", kind, is_now};
  }
  return {};
}

/// Two significant digits.
int rounded(double count) {
  const double step = std::pow(10, std::max(0.0, std::floor(std::log10(count)) - 1));
  return static_cast<int>(std::round(count / step) * step);
}

/// Numbers round that of the file; `given` stands for what it came to.
std::vector<Offer<int>> fineness_offers(const BareMeshChoices& chosen, int own_tets, bool is_scan) {
  const std::optional<int>& given = chosen.given.tets;
  std::set<int> numbers;
  for (const double fraction : fractions)
    if (const int tets = rounded(fraction * own_tets); tets >= min_tets && tets <= max_tets) numbers.insert(tets);
  if (!is_scan) numbers.insert(own_tets);
  const int now = given.value_or(chosen.tets);
  std::vector<Offer<int>> offers;
  const auto add_now = [&] {
    offers.push_back({grouped_digits(chosen.tets),
                      fmt::format("The smallest dihedral angle is {:.2g}°.", chosen.min_dihedral), now, true});
  };
  for (const int tets : numbers) {
    const bool has_now = !offers.empty() && offers.back().value >= now;
    if (tets >= now && !has_now) add_now();
    if (given == tets) continue;
    offers.push_back(
        tets == now ? Offer<int>{grouped_digits(tets) + ", better shapes", "As many, with better shapes.", tets, false}
        : tets < now
            ? Offer<int>{grouped_digits(tets) + ", coarser", "Larger elements: faster, less exact.", tets, false}
            : Offer<int>{grouped_digits(tets) + ", finer", "Smaller elements: slower, more exact.", tets, false});
  }
  if (offers.empty() || offers.back().value < now) add_now();
  return offers;
}

}  // namespace

/// Why it is as it is.
std::string MeshSection::reason(const char* about) const {
  for (const BareMeshChoices::Text& text : chosen_->texts)
    if (text.about == about) return "Now: " + text.text + ".\n\n" + reopens;
  return reopens;
}

/// Unit and length: both say how large the body is.
bool MeshSection::draw_size(Rows& rows, BareMeshOptions& options) const {
  if (is_scan_) return false;
  bool changed = choose(rows, {"Unit", "Unit of the file. " + reason("unit")}, unit_offers(*chosen_), options.unit);
  double centimetres = 100 * chosen_->length;
  if (rows.number(
          {"Length", fmt::format("Longest side of the body's box, cm. Click to type it where no unit is right, {:g} "
                                 "to {:g} cm: the body is scaled to it.",
                                 min_length, max_length)},
          centimetres, {min_length, max_length, "%.4g cm"})) {
    const double file_length = chosen_->length / chosen_->scale;
    options.unit = LengthUnit{"", centimetres / 100 / file_length};
    changed = true;
  }
  return changed;
}

/// The preset of the body's material now, which may have been chosen in Material too.
bool MeshSection::draw_tissue(Rows& rows, const std::vector<RegionMaterial>& materials,
                              BareMeshOptions& options) const {
  if (materials.empty() || opened_.empty()) return false;
  const Material &now = materials.front().material, &opened = opened_.front().material;
  const Preset* preset = preset_of(now);
  std::vector<Offer<std::string>> offers;
  if (!chosen_->given.tissue)
    offers.push_back({fmt::format("soft, {}", quantity(chosen_->young, "Pa")),
                      "Neo-Hookean, the softest that its own weight does not stretch by more than half.", "",
                      !preset && now == opened});
  for (const Preset& each : presets()) offers.push_back({each.title, tissue_hint(each), each.name, &each == preset});
  if (!choose(rows,
              {"Tissue", "What the body is made of, all regions alike; – : set in Material below. " + reason("tissue")},
              offers, options.tissue))
    return false;
  if (options.tissue && options.tissue->empty()) options.tissue.reset();
  return true;
}

bool MeshSection::draw_fineness(Rows& rows, BareMeshOptions& options) const {
  return choose(
      rows,
      {"Tetrahedra",
       (is_scan_ ? "Number of tetrahedra, met within a quarter. "
                 : fmt::format("Number of tetrahedra, {} as read. Another number gives elements better shapes "
                               "too and moves the surface by 0.5 % of the body's size at most. ",
                               grouped_digits(own_tets()))) +
           reason("fineness")},
      fineness_offers(*chosen_, own_tets(), is_scan_), options.tets);
}

void MeshSection::draw_findings(Rows& rows) const {
  if (chosen_->findings.empty())
    rows.value({"Found", "Holes, self-intersections, slivers, inverted elements, loose parts were looked for."},
               "nothing wrong", colours::accent);
  for (const BareMeshChoices::Finding& finding : chosen_->findings)
    rows.value({fmt::format("{} {}", grouped_digits(finding.count), finding.found), finding.detail}, finding.done,
               finding.is_mended ? colours::accent : colours::warning);
}

/// What was told in full, and the buttons.
void MeshSection::draw_end(Rows& rows, const std::vector<std::string>& texts, PanelActions& out) {
  if (!texts.empty() &&
      rows.folding_value({"Reasons", "Why each of them was chosen, and all that was said on opening."}, "", false)) {
    const UseFont small(Font::small);
    ImGui::PushTextWrapPos(0);
    for (const std::string& text : texts) ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
  }
  if (rows.button({"Keep as scene",
                   "Writes a complete scene file with all that is set here and below into the working "
                   "folder (Ctrl+S)."}))
    out.requests.push_back(Request::save);
  ImGui::SameLine();
  if (rows.button({"Close",
                   "Folds this away, for this file also at the next start. A click on “This mesh” opens "
                   "it again."}))
    open_ = false;
  if (kept_.empty()) return;
  const std::string name = elided(kept_.filename().string(), ImGui::GetContentRegionAvail().x - em(3));
  rows.value({"Kept", kept_.string() + "\n\nheml run opens it; it is a text to edit."}, name);
}

void MeshSection::draw(Rows& rows, const std::vector<RegionMaterial>& materials, const std::vector<std::string>& texts,
                       PanelActions& out) {
  if (!chosen_ || !rows.fold("This mesh", open_)) return;
  ImGui::PushID("This mesh");  // Material has a row of the name Tissue too
  BareMeshOptions options = chosen_->given;
  bool changed = draw_size(rows, options);
  changed |=
      choose(rows, {"Up", "Axis of the file that points up. " + reason("up")}, up_offers(chosen_->up), options.up);
  std::vector<Offer<SupportKind>> supports;
  for (const SupportKind kind : support_kinds) supports.push_back(support_offer(kind, kind == chosen_->supports));
  changed |= choose(rows, {"Supports", "What carries the body. " + reason("supports")}, supports, options.supports);
  changed |= draw_tissue(rows, materials, options);
  changed |= draw_fineness(rows, options);
  draw_findings(rows);
  draw_end(rows, texts, out);
  ImGui::PopID();
  if (changed) out.mesh_options = options;
}

}  // namespace heml::panel
