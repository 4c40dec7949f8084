// Gmsh: https://gmsh.info/doc/texinfo/gmsh.html, "MSH file format", $ElementData, identical in versions 2 and 4.
#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/gmsh_data.hpp>

namespace heml {
namespace {

constexpr long long max_tags = 1000;

bool by_number(const GmshElement& a, const GmshElement& b) { return a.number < b.number; }

std::size_t tag_count(Scanner& in, std::string_view what) {
  in.expect_word(what);
  return static_cast<std::size_t>(in.integer(what, 0, max_tags));
}

// A name without its quotes, from the next line; expect_line() then moves past that line.
std::string name_from(Scanner& in) {
  in.expect_line("the name of the data");
  std::string_view line = in.rest().substr(0, in.rest().find('\n'));
  line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
  if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
  return std::string(line);
}

}  // namespace

void GmshData::read(Scanner& in, GmshNumbers& numbers, ReadMesh& read) {
  Section section = header(in);
  const std::size_t components = section.components;
  bool wanted = is_field_size(components) && !section.name.empty();
  if (wanted && first_step_.try_emplace(section.name, section.step).first->second != section.step) {
    read.more_steps = true;
    wanted = false;
  }
  numbers.begin_binary();
  if (numbers.binary() && !wanted) return numbers.skip(section.count, sizeof(int) + components * sizeof(double));
  for (std::size_t e = 0; e < section.count; ++e) {
    numbers.line("an element's data");
    if (!wanted) continue;
    section.elements.push_back(numbers.wide_integer("an element number", false));
    for (std::size_t i = 0; i < components; ++i) section.values.push_back(numbers.any_number("a value"));
    numbers.end_line("the element's data");
  }
  if (wanted) sections_.push_back(std::move(section));
}

GmshData::Section GmshData::header(Scanner& in) {
  Section section;
  const std::size_t texts = tag_count(in, "the number of string tags");
  for (std::size_t i = 0; i < texts; ++i) {
    const std::string text = name_from(in);
    if (i == 0) section.name = text;
  }
  if (texts > 0) in.expect_line("the number of real tags");
  for (std::size_t left = tag_count(in, "the number of real tags"); left > 0; --left) {
    in.expect_word("a real tag");
    in.any_number("a real tag");
  }
  const std::size_t integers = tag_count(in, "the number of integer tags");
  if (integers < 3) in.fail(fmt::format("{} integer tags", integers), "time step, components, number of elements");
  in.expect_word("the time step");
  section.step = in.integer("the time step");
  in.expect_word("the number of components");
  section.components = static_cast<std::size_t>(in.integer("the number of components", 0, max_tags));
  in.expect_word("the number of elements");
  section.count = in.count("the number of elements", 1 + section.components);  // fewer bytes than binary values take
  for (std::size_t i = 3; i < integers; ++i) {
    in.expect_word("an integer tag");
    in.wide_integer("an integer tag");
  }
  return section;
}

void GmshData::put(std::vector<GmshElement> tets, const Scanner& in, ReadMesh& read) const {
  if (!std::is_sorted(tets.begin(), tets.end(), by_number)) std::sort(tets.begin(), tets.end(), by_number);
  const auto first_of = [&](long long number) -> const GmshElement* {
    const auto at = std::lower_bound(tets.begin(), tets.end(), GmshElement{number, 0}, by_number);
    return at != tets.end() && at->number == number ? &*at : nullptr;
  };
  const auto names_a_tet = [&](const Section& section) {
    return std::any_of(section.elements.begin(), section.elements.end(), first_of);
  };
  std::vector<const Section*> named;
  for (const Section& section : sections_)
    if (names_a_tet(section)) {
      named.push_back(&section);
      field_in(read.mesh, section.name, section.components, in);
    }
  pad_fields(read.mesh, in);
  for (const Section* section : named) {
    ElementField& field = field_in(read.mesh, section->name, section->components, in);
    const double* value = section->values.data();
    for (const long long number : section->elements) {
      if (const GmshElement* element = first_of(number))
        std::copy_n(value, field.components, &field.values[field.components * static_cast<std::size_t>(element->tet)]);
      value += field.components;
    }
  }
  // Tetrahedra with equal numbers get the same values. Copied once at the end: per value would take quadratic time.
  for (ElementField& field : read.mesh.fields)
    for (std::size_t i = 1; i < tets.size(); ++i)
      if (tets[i].number == tets[i - 1].number)
        std::copy_n(&field.values[field.components * static_cast<std::size_t>(tets[i - 1].tet)], field.components,
                    &field.values[field.components * static_cast<std::size_t>(tets[i].tet)]);
}

}  // namespace heml
