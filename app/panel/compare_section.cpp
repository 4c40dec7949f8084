#include <fmt/format.h>
#include <imgui.h>

#include <app/panel/compare_section.hpp>
#include <app/panel/quantity.hpp>
#include <heml/session/comparison_runs.hpp>

namespace heml::panel {
namespace {

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"same law"};
    for (const LawInfo& law : laws()) all.emplace_back(law.name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"same integrator"};
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
                                 ? fmt::format("Distance between the surfaces, m: mean {}, max {}.",
                                               quantity(body.distance->mean, "m"), quantity(body.distance->max, "m"))
                                 : "Topology differs (other cuts): no distance can be measured."},
               distance_of(body));
  }
  if (!variants.empty() &&
      rows.button({"Remove comparisons", "Ends all comparison runs; the body continues from the shown time."}))
    out.comparisons.emplace();
  if (variants.size() >= ComparisonRuns::max) return;
  rows.choice(
      {"Other law", "The same body under this law with the same small-strain moduli, driven by the same commands."},
      law_, law_names());
  rows.choice({"Other method", "The same body under this time integrator."}, method_, method_names());
  const bool is_same = law_ == 0 && method_ == 0;
  if (is_same) ImGui::BeginDisabled();
  if (rows.button(
          {"Add comparison", "Replays the session to the shown time with this variant in lockstep, then continues."})) {
    std::string variant = law_ > 0 ? law_names()[static_cast<std::size_t>(law_)] : "";
    if (method_ > 0) variant += (variant.empty() ? "" : "+") + method_names()[static_cast<std::size_t>(method_)];
    variants.push_back(variant);
    out.comparisons = variants;
    law_ = method_ = 0;
  }
  if (is_same) ImGui::EndDisabled();
}

}  // namespace heml::panel
