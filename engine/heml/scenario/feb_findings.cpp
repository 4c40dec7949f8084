#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/mesh/readers.hpp>
#include <heml/scenario/feb_findings.hpp>

namespace heml {
namespace {

void add_once(std::string text, std::vector<std::string>& to) {
  if (std::find(to.begin(), to.end(), text) == to.end()) to.push_back(std::move(text));
}

}  // namespace

void FebFindings::refuse(const XmlElement& at, const std::string& text) {
  add_once(fmt::format("line {}: {}", at.line(), text), refused_);
}

void FebFindings::note(const XmlElement& at, const std::string& text) {
  add_once(fmt::format("line {}: {}", at.line(), text), notes_);
}

void FebFindings::throw_refused(const std::string& file) const {
  if (refused_.empty()) return;
  throw InputError(file, "",
                   fmt::format("holds {} thing{} that heml does not compute as FEBio does: {}", refused_.size(),
                               refused_.size() == 1 ? "" : "s", fmt::join(refused_, "; ")),
                   "change them, or take the file as a mesh alone: \"mesh\": {\"file\": ...} in a scene");
}

std::string feb_tag(const XmlElement& element) { return fmt::format("<{}>", plain_name(element.name())); }

std::string feb_name(const XmlElement& element) {
  std::string text = feb_tag(element);
  if (const auto name = element.attribute("name")) text += " '" + plain_name(*name) + "'";
  if (const auto type = element.attribute("type")) text += " of type " + plain_name(*type);
  return text;
}

}  // namespace heml
