#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <app/panel/compare_section.hpp>
#include <app/panel/quantity.hpp>
#include <heml/session/comparison_runs.hpp>
#include <sstream>

namespace heml::panel {
namespace {

/// What a choice offers: titles for people, and the words of variant_of(); the first means no change.
struct Choices {
  std::vector<std::string> titles, words;
  void add(std::string title, std::string word) {
    titles.push_back(std::move(title));
    words.push_back(std::move(word));
  }
};

const Choices& law_choices() {
  static const Choices all = [] {
    Choices choices;
    choices.add("same law", "");
    for (const LawInfo& law : laws()) choices.add(std::string(law.title), std::string(law.name));
    return choices;
  }();
  return all;
}

const Choices& method_choices() {
  static const Choices all = [] {
    Choices choices;
    choices.add("same integrator", "");
    for (const Integrator integrator : moving_integrators())
      choices.add(std::string(info_of(integrator).title), std::string(integrator_name(integrator)));
    return choices;
  }();
  return all;
}

std::string distance_of(const Frame& body) {
  if (!body.halted.empty()) return "stopped";
  return body.distance ? quantity(body.distance->mean, "m") : "–";
}

}  // namespace

std::string variant_title(const std::string& variant) {
  std::string title, separated = variant;
  std::replace(separated.begin(), separated.end(), ',', '+');  // the body's own name: "stvk, verlet"
  std::istringstream words(separated);
  for (std::string word; std::getline(words >> std::ws, word, '+');) {
    for (const Choices* choices : {&law_choices(), &method_choices()}) {
      const auto found = std::find(choices->words.begin(), choices->words.end(), word);
      if (found == choices->words.end()) continue;
      word = choices->titles[static_cast<std::size_t>(found - choices->words.begin())];
      break;
    }
    title += (title.empty() ? "" : ", ") + word;
  }
  return title;
}

void CompareSection::draw(Rows& rows, const Frame& frame, PanelActions& out) {
  std::vector<std::string> variants;
  for (const Frame& body : frame.comparisons) variants.push_back(body.variant);
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const Frame& body = frame.comparisons[k];
    rows.value({variant_title(variants[k]),
                !body.halted.empty() ? body.halted
                : body.distance      ? fmt::format("Distance between the surfaces, m: mean {}, max {}.",
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
      law_, law_choices().titles);
  rows.choice({"Other method", "The same body under this time integrator."}, method_, method_choices().titles);
  const bool is_same = law_ == 0 && method_ == 0;
  if (is_same) ImGui::BeginDisabled();
  if (rows.button(
          {"Add comparison", "Replays the session to the shown time with this variant in lockstep, then continues."})) {
    std::string variant = law_choices().words[static_cast<std::size_t>(law_)];
    if (method_ > 0)
      variant += (variant.empty() ? "" : "+") + method_choices().words[static_cast<std::size_t>(method_)];
    variants.push_back(variant);
    out.comparisons = variants;
    law_ = method_ = 0;
  }
  if (is_same) ImGui::EndDisabled();
}

}  // namespace heml::panel
