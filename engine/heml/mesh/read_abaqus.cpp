// Abaqus and CalculiX .inp files: CalculiX CrunchiX User's Manual, "Input deck format", *NODE, *ELEMENT, *ELSET, *SOLID
// SECTION. Lines of keywords begin with *, comments with **; the lines after a keyword hold its data, by commas.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <heml/mesh/element_sets.hpp>
#include <heml/mesh/readers.hpp>
#include <optional>

namespace heml {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\f\v";
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// The parts between commas, without blanks around them; a comma at the end begins no part.
void split(std::string_view line, std::vector<std::string_view>& parts) {
  parts.clear();
  for (line = trimmed(line); !line.empty();) {
    const std::size_t comma = std::min(line.find(','), line.size());
    parts.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(std::min(comma + 1, line.size()));
  }
}

std::string_view unquoted(std::string_view name) {
  return name.size() >= 2 && name.front() == '"' && name.back() == '"' ? name.substr(1, name.size() - 2) : name;
}

/// In capitals and without blanks, as keywords are compared.
std::string plain(std::string_view word) {
  std::string text;
  for (const char c : word)
    if (c != ' ' && c != '\t') text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// By the number of nodes of a solid element; corners stand first, and are wound as in VTK but for its wedge.
std::optional<CellShape> shape_of_solid(std::size_t nodes) {
  if (nodes == 4 || nodes == 10) return CellShape::tetrahedron;
  if (nodes == 5 || nodes == 13) return CellShape::pyramid;
  if (nodes == 6 || nodes == 15 || nodes == 18) return CellShape::wedge;
  if (nodes == 8 || nodes == 20 || nodes == 27) return CellShape::brick;
  return std::nullopt;
}

/// How many nodes a solid element has by its type, C3D10M: 10; 0: no solid, or not known.
std::size_t nodes_of_solid(const std::string& type) {
  const std::size_t begin = type.starts_with("DC3D") ? 4 : type.starts_with("C3D") ? 3 : type.size();
  std::size_t nodes = 0;
  std::from_chars(type.data() + begin, type.data() + type.size(), nodes);
  return nodes <= 27 ? nodes : 0;
}

class AbaqusReader {
 public:
  AbaqusReader(std::string file, std::string_view text) : start_(std::move(file), text), in_(start_) {}

  // Two passes: elements may stand before their nodes.
  ReadMesh read() {
    pass(true);
    nodes_.finish(in_);
    in_ = start_;
    pass(false);
    sets_.put(element_numbers_, in_, read_.mesh);
    return std::move(read_);
  }

 private:
  enum class Card { none, nodes, elements, set, other };

  void pass(bool of_nodes) {
    card_ = Card::none;
    parts_count_ = instances_ = 0;
    in_assembly_ = in_instance_ = false;
    std::vector<std::string_view> parts;
    while (in_.left() > 0) {
      const std::string_view line = trimmed(in_.rest_of_line());
      if (line.empty() || line.starts_with("**")) continue;
      split(line, parts);
      if (line[0] == '*') {
        end_element();
        std::string whole(line);
        while (whole.back() == ',' && in_.left() > 0) whole += trimmed(in_.rest_of_line());
        split(whole, parts);
        keyword(parts);
      } else if (card_ == Card::none) {
        in_.fail("a keyword should begin here, found " + in_quotes(line), "*NODE, *ELEMENT, ...");
      } else if (card_ == Card::nodes && of_nodes) {
        node(parts);
      } else if (card_ == Card::elements && !of_nodes) {
        element(parts);
      } else if (card_ == Card::set && !of_nodes) {
        members(parts);
      }
    }
    end_element();
  }

  void keyword(const std::vector<std::string_view>& parts) {
    const std::string name = plain(parts[0]);
    card_ = Card::other;
    if (name == "*INCLUDE")
      in_.fail("another file is included: " + in_quotes(value(parts, "INPUT")), "put its lines here in place of this");
    in_assembly_ = (in_assembly_ || name == "*ASSEMBLY") && name != "*ENDASSEMBLY";
    in_instance_ = (in_instance_ || name == "*INSTANCE") && name != "*ENDINSTANCE";
    if ((name == "*PART" && ++parts_count_ > 1) || (name == "*INSTANCE" && ++instances_ > 1))
      in_.fail("a second " + name.substr(1), "save one part alone, or all without parts and assemblies");
    const bool of_part = !in_assembly_ || in_instance_;  // nodes of the assembly itself are points of reference
    if (name == "*NODE" && of_part) {
      card_ = Card::nodes;
    } else if (name == "*ELEMENT" && of_part) {
      card_ = Card::elements;
      element_nodes_ = nodes_of_solid(plain(value(parts, "TYPE")));
      has_set_ = begin_set(value(parts, "ELSET"));
    } else if (name == "*ELSET") {
      card_ = begin_set(value(parts, "ELSET")) ? Card::set : Card::other;
      generate_ = std::any_of(parts.begin(), parts.end(), [](auto part) { return plain(part) == "GENERATE"; });
    } else if (name == "*SOLIDSECTION") {
      sets_.choose(value(parts, "ELSET"));
    }
  }

  /// Of KEY=value among a keyword's parameters; empty: there is none.
  static std::string_view value(const std::vector<std::string_view>& parts, std::string_view key) {
    for (const std::string_view part : parts)
      if (const std::size_t equals = part.find('='); equals < part.size() && plain(part.substr(0, equals)) == key)
        return unquoted(trimmed(part.substr(equals + 1)));
    return {};
  }

  bool begin_set(std::string_view name) {
    if (!name.empty()) set_ = sets_.find_or_add(name, in_);
    return !name.empty();
  }

  void node(const std::vector<std::string_view>& parts) {
    nodes_.add(integer(parts[0], "a node number"));
    Vec3 x = Vec3::Zero();
    for (std::size_t i = 1; i < std::min<std::size_t>(parts.size(), 4); ++i)
      x[static_cast<int>(i - 1)] = real(parts[i]);
    read_.mesh.nodes.push_back(x);
  }

  // An element goes on in the next line until it has its nodes.
  void element(const std::vector<std::string_view>& parts) {
    if (element_nodes_ == 0) return;
    for (const std::string_view part : parts)
      element_.push_back(integer(part, element_.empty() ? "an element number" : "a node number"));
    if (element_.size() > 1 + element_nodes_)
      in_.fail(fmt::format("element {} has more than {} nodes", element_[0], element_nodes_));
    if (element_.size() < 1 + element_nodes_) return;
    if (has_set_) sets_.add(set_, {element_[0], element_[0]});
    if (const auto shape = shape_of_solid(element_nodes_))
      solid(*shape);
    else
      ++read_.ignored;
    element_.clear();
  }

  void end_element() {
    if (!element_.empty())
      in_.fail(fmt::format("element {} has {} nodes", element_[0], element_.size() - 1),
               fmt::format("{} by its type", element_nodes_));
  }

  void solid(CellShape shape) {
    std::array<int, 27> nodes{};
    for (std::size_t a = 0; a < element_nodes_; ++a) nodes[a] = nodes_.find(element_[1 + a], in_);
    if (shape != CellShape::tetrahedron)
      divide_cell(shape, std::span(nodes).first(element_nodes_), read_);
    else
      read_.mesh.tets.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
    element_numbers_.resize(read_.mesh.tets.size(), element_[0]);
    if (element_nodes_ == 10)  // the middles of 12, 23, 31, 14, 24, 34, as in VTK
      add_midedges({nodes[4], nodes[5], nodes[6], nodes[7], nodes[8], nodes[9]}, vtk_midedges, read_);
  }

  // Numbers and names of sets, or with GENERATE: first, last, step.
  void members(const std::vector<std::string_view>& parts) {
    if (generate_) {
      if (parts.size() < 2) in_.fail("a line after GENERATE should hold the first number, the last, and the step");
      const NumberRange range{integer(parts[0], "the first number"), integer(parts[1], "the last number"),
                              parts.size() > 2 ? integer(parts[2], "the step") : 1};
      if (range.step < 1) in_.fail(fmt::format("the step is {}", range.step), "1 or more");
      return sets_.add(set_, range);
    }
    for (const std::string_view part : parts) {
      if (part.empty()) continue;
      if (part[0] == '-' || (part[0] >= '0' && part[0] <= '9')) {
        const long long number = integer(part, "an element number");
        sets_.add(set_, {number, number});
      } else {
        sets_.add_set(set_, unquoted(part), in_);
      }
    }
  }

  long long integer(std::string_view part, const char* what) const {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (part.empty() || error != std::errc() || end != part.data() + part.size())
      in_.fail(fmt::format("{} should be a whole number, is {}", what, in_quotes(part)));
    return value;
  }

  double real(std::string_view part) const {
    if (part.empty()) return 0;  // as Abaqus takes it
    if (part[0] == '+') part.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(value))
      in_.fail("a coordinate should be a number, is " + in_quotes(part));
    return value;
  }

  Scanner start_, in_;
  ReadMesh read_;
  NodeNumbers nodes_;
  ElementSets sets_;
  std::vector<long long> element_numbers_;  ///< of each tetrahedron
  std::vector<long long> element_;          ///< number and nodes of an element, as far as they are read
  std::size_t element_nodes_ = 0;           ///< of the elements that are read; 0: they are passed over
  std::size_t set_ = 0;
  Card card_ = Card::none;
  bool has_set_ = false, generate_ = false, in_assembly_ = false, in_instance_ = false;
  int parts_count_ = 0, instances_ = 0;
};

}  // namespace

ReadMesh read_abaqus(std::string file, std::string_view text) { return AbaqusReader(std::move(file), text).read(); }

}  // namespace heml
