#include <fmt/format.h>

#include <app/panel/mesh_section.hpp>
#include <heml/scenario/body_shape.hpp>

namespace heml::panel {
namespace {

template <class Value>
struct Offer {
  std::string name, hint;
  Value value;
  bool is_now;
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
  if (given) names.emplace_back("as guessed");
  if (!rows.choice(label, index, names, hints)) return false;
  const auto chosen = static_cast<std::size_t>(index);
  if (chosen < offers.size())
    given = offers[chosen].value;
  else
    given.reset();
  return true;
}

std::vector<Offer<LengthUnit>> unit_offers(const BareMeshChoices& chosen) {
  std::vector<Offer<LengthUnit>> offers;
  const double length = chosen.length / chosen.scale;  // in the file
  for (const LengthUnit& unit : plausible_units(length)) {
    const std::string metres = fmt::format("{:.3g} m", unit.scale * length);
    const bool is_now = unit.name == chosen.unit;  // the closed choice has no room for the length
    offers.push_back({unit.name.empty() ? "scaled to " + metres
                      : is_now          ? unit.name
                                        : unit.name + ", " + metres,
                      "Makes the body " + metres + " long.", unit, is_now});
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
      return {"underside held", "Rests on its lowest part, which is held.", kind, is_now};
    case SupportKind::top:
      return {"top held", "Hangs from its highest part, which is held.", kind, is_now};
    case SupportKind::table:
      return {"on a table", "Lies loose on a table with friction.", kind, is_now};
  }
  return {};
}

}  // namespace

/// Why it is as it is.
std::string MeshSection::reason(const char* about) const {
  for (const BareMeshChoices::Text& text : chosen_->texts)
    if (text.about == about) return "Now: " + text.text + ".\n\nAnother choice opens the mesh again.";
  return "";
}

void MeshSection::draw(Rows& rows, PanelActions& out) const {
  if (!chosen_) return;
  BareMeshOptions options = chosen_->given;
  bool changed = false;
  if (!is_scan_)
    changed |= choose(rows, {"Unit", "Unit of the file. " + reason("unit")}, unit_offers(*chosen_), options.unit);
  changed |=
      choose(rows, {"Up", "Axis of the file that points up. " + reason("up")}, up_offers(chosen_->up), options.up);
  std::vector<Offer<SupportKind>> supports;
  for (const SupportKind kind : support_kinds) supports.push_back(support_offer(kind, kind == chosen_->supports));
  changed |= choose(rows, {"Supports", "What carries the body. " + reason("supports")}, supports, options.supports);
  std::string notes;
  int count = 0;
  for (const BareMeshChoices::Text& text : chosen_->texts)
    if (text.about == "mesh") {
      notes += fmt::format("{}{}", count > 0 ? "\n\n" : "", text.text);
      ++count;
    }
  if (count > 0) rows.value({"Found", notes}, fmt::format("{} note{}", count, count == 1 ? "" : "s"));
  if (changed) out.mesh_options = options;
}

}  // namespace heml::panel
