#include <fmt/format.h>
#include <imgui.h>

#include <app/panel/compare_section.hpp>
#include <app/panel/quantity.hpp>
#include <heml/session/comparison_runs.hpp>

namespace heml::panel {
namespace {

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"the same law"};
    for (const LawInfo& law : laws()) all.emplace_back(law.name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"the same method"};
    for (const Integrator integrator : moving_integrators()) all.emplace_back(integrator_name(integrator));
    return all;
  }();
  return names;
}

std::string distance_of(const Frame& body) {
  if (!body.halted.empty()) return "stopped";
  return body.distance ? quantity(body.distance->mean, "m") : "–";
}

}  // namespace

void CompareSection::draw(Rows& rows, const Frame& frame, PanelActions& out) {
  std::vector<std::string> variants;
  for (const Frame& body : frame.comparisons) variants.push_back(body.variant);
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const Frame& body = frame.comparisons[k];
    rows.value({variants[k], !body.halted.empty() ? body.halted
                             : body.distance
                                 ? fmt::format("Distance of its surface from the body's, m: {} in the mean, "
                                               "{} at most.",
                                               quantity(body.distance->mean, "m"), quantity(body.distance->max, "m"))
                                 : "Its mesh was cut differently: no pairs of nodes to measure."},
               distance_of(body));
  }
  if (!variants.empty() &&
      rows.button({"Remove comparisons", "Ends all comparison runs; the body goes on from the shown time."}))
    out.comparisons.emplace();
  if (variants.size() >= ComparisonRuns::max) return;
  rows.choice({"Another law", "The same tissue under this law, as stiff at rest, with the same things done to it."},
              law_, law_names());
  rows.choice({"Another method", "The same tissue under this time integrator."}, method_, method_names());
  const bool is_same = law_ == 0 && method_ == 0;
  if (is_same) ImGui::BeginDisabled();
  if (rows.button({"Add comparison",
                   "Runs this variant in lockstep with the body, from the start to the shown time and on."})) {
    std::string variant = law_ > 0 ? law_names()[static_cast<std::size_t>(law_)] : "";
    if (method_ > 0) variant += (variant.empty() ? "" : "+") + method_names()[static_cast<std::size_t>(method_)];
    variants.push_back(variant);
    out.comparisons = variants;
    law_ = method_ = 0;
  }
  if (is_same) ImGui::EndDisabled();
}

}  // namespace heml::panel
