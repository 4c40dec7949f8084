#include <fmt/format.h>
#include <imgui.h>

#include <app/panel/beside_section.hpp>
#include <app/panel/quantity.hpp>
#include <heml/session/companions.hpp>

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
  static const std::vector<std::string> names{"the same method", "symplectic_euler", "verlet", "backward_euler", "bdf2",
                                              "tr_bdf2"};
  return names;
}

std::string distance_of(const Frame& body) {
  if (!body.halted.empty()) return "stopped";
  return body.apart ? quantity(body.apart->mean, "m") : "–";
}

}  // namespace

void BesideSection::draw(Rows& rows, const Frame& frame, PanelActions& out) {
  std::vector<std::string> ways;
  for (const Frame& body : frame.beside) ways.push_back(body.way);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const Frame& body = frame.beside[k];
    rows.value({ways[k], !body.halted.empty() ? body.halted
                         : body.apart ? fmt::format("Distance of its surface from the body's, m: {} in the mean, "
                                                    "{} at most.",
                                                    quantity(body.apart->mean, "m"), quantity(body.apart->most, "m"))
                                      : "It was cut in another way: there are no pairs of points to measure."},
               distance_of(body));
  }
  if (!ways.empty() && rows.button({"Take away", "The body alone again, at this moment."})) out.beside.emplace();
  if (ways.size() >= Companions::most) return;
  rows.choice({"Another law", "The same tissue under this law, as stiff at rest, with the same things done to it."},
              law_, law_names());
  rows.choice({"Another method", "The same tissue with its steps in time taken in this way."}, method_, method_names());
  const bool is_same = law_ == 0 && method_ == 0;
  if (is_same) ImGui::BeginDisabled();
  if (rows.button({"Set beside", "Puts it beside the body, in lockstep from the start to this moment and on."})) {
    std::string way = law_ > 0 ? law_names()[static_cast<std::size_t>(law_)] : "";
    if (method_ > 0) way += (way.empty() ? "" : "+") + method_names()[static_cast<std::size_t>(method_)];
    ways.push_back(way);
    out.beside = ways;
    law_ = method_ = 0;
  }
  if (is_same) ImGui::EndDisabled();
}

}  // namespace heml::panel
