#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/mesh/quadratic.hpp>
#include <heml/scenario/material_fields.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/young_poisson.hpp>
#include <set>

namespace heml {
namespace {

/// The elements an entry of `materials` applies to, as material_of_elements() assigns them; ascending.
std::vector<std::size_t> elements_of(std::optional<int> region, const std::vector<RegionMaterial>& materials,
                                     const TetMesh& mesh) {
  std::set<int> own;
  for (const RegionMaterial& entry : materials)
    if (entry.region) own.insert(*entry.region);
  std::vector<std::size_t> elements;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (region ? mesh.regions[t] == *region : !own.contains(mesh.regions[t])) elements.push_back(t);
  return elements;
}

std::string described(const TetMesh& mesh) {
  std::vector<std::string> names;
  for (const ElementField& field : mesh.fields)
    if (!young_poisson_behind(field.name))
      names.push_back(fmt::format("{} ({})", shown(std::string_view(field.name)), field.components));
  if (names.empty()) return "it has none";
  return fmt::format("its fields and the numbers of each an element: {}", fmt::join(names, ", "));
}

/// Checks and resolves the fields of one material.
class Check {
 public:
  Check(const Material& material, const std::vector<std::size_t>& elements, TetMesh& mesh, std::string file,
        std::string place, bool quadratic)
      : material_(material),
        elements_(elements),
        mesh_(mesh),
        file_(std::move(file)),
        place_(std::move(place)),
        quadratic_(quadratic) {}

  void run() {
    for (const FieldParameter& field : material_.fields) add_made_field(field.field);
    if (!material_.fibre_field.empty()) take_fibres();
    check_parameters();
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& remedy) const {
    throw InputError(file_, fmt::format("{}.{}", place_, key), problem, remedy);
  }

  ElementField& field_of(const std::string& key, const std::string& name, std::size_t components) const {
    const auto found = std::find_if(mesh_.fields.begin(), mesh_.fields.end(),
                                    [&](const ElementField& field) { return field.name == name; });
    const std::string_view short_name = name;
    if (found == mesh_.fields.end())
      fail(key, fmt::format("{} has no field '{}'", mesh_.source, shown(short_name)), described(mesh_));
    if (found->components != components)
      fail(key,
           fmt::format("the field '{}' of {} has {} numbers an element", shown(short_name), mesh_.source,
                       found->components),
           components != 3                         ? fmt::format("{} are wanted", components)
           : quadratic_                            ? "3 are wanted, or 12: at its integration points"
           : found->components == point_components ? "3 are wanted; 12 are for \"element\": \"p2\""
                                                   : "3 are wanted");
    return *found;
  }

  /// The checked values of a quantity, #T.
  std::vector<double> values_of(const std::string& key, const Quantity& quantity,
                                std::string (*problem)(double)) const {
    if (quantity.field.empty()) return std::vector<double>(mesh_.tets.size(), quantity.value);
    const std::vector<double> values = field_of(key, quantity.field, 1).values;
    for (const std::size_t t : elements_)
      if (const std::string text = problem(values[t]); !text.empty())
        fail(key,
             fmt::format("the field '{}' is {} in element {}", shown(std::string_view(quantity.field)), values[t], t),
             text);
    return values;
  }

  void add_made_field(const std::string& name) {
    const auto pair = young_poisson_behind(name);
    if (!pair) return;
    const std::vector<double> young = values_of("young", pair->young, young_problem);
    const std::vector<double> poisson = values_of("poisson", pair->poisson, poisson_problem);
    if (find_field(mesh_, name)) return;
    ElementField made{name, 1, {}};
    for (std::size_t t = 0; t < young.size(); ++t) {
      const LameParameters lame = lame_parameters(young[t], poisson[t]);
      made.values.push_back(name.starts_with("lambda") ? lame.lambda : lame.mu);
    }
    mesh_.fields.push_back(std::move(made));
  }

  void take_fibres() {
    const ElementField* given = find_field(mesh_, material_.fibre_field);
    const bool of_points = quadratic_ && given && given->components == point_components;
    std::vector<double>& values = field_of("fibre", material_.fibre_field, of_points ? point_components : 3).values;
    const std::size_t each = of_points ? element_points : 1;
    for (std::size_t k = 0; k < each * elements_.size(); ++k) {
      const std::size_t t = elements_[k / each];
      Eigen::Map<Vec3> fibre(&values[3 * (each * t + k % each)]);
      const double length = fibre.stableNorm();
      if (!(length > 0) || !std::isfinite(length))
        fail("fibre",
             fmt::format("the field '{}' is [{}, {}, {}] in element {}", shown(std::string_view(material_.fibre_field)),
                         fibre[0], fibre[1], fibre[2], t),
             "must be a direction: finite and not all of its numbers 0");
      fibre /= length;
    }
  }

  void check_parameters() const {
    const std::vector<ParameterSlot> slots = parameter_slots(material_, *find_law(material_.law));
    Material at = material_;
    std::vector<const double*> values;
    for (const FieldParameter& field : material_.fields)
      values.push_back(field_of(slots.at(field.parameter).key(), field.field, 1).values.data());
    for (const std::size_t t : elements_) {
      for (std::size_t k = 0; k < values.size(); ++k) at.parameters[material_.fields[k].parameter] = values[k][t];
      if (const auto problem = material_problem(at)) refuse(problem->first, problem->second, slots, t);
    }
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::vector<ParameterSlot>& slots,
                           std::size_t t) const {
    for (const FieldParameter& field : material_.fields)
      if (slots[field.parameter].key() == key)
        fail(key, fmt::format("the field '{}' in element {}: {}", shown(std::string_view(field.field)), t, problem),
             "");
    fail(key, fmt::format("in element {}: {}", t, problem), "");
  }

  const Material& material_;
  const std::vector<std::size_t>& elements_;
  TetMesh& mesh_;
  std::string file_, place_;
  bool quadratic_;
};

/// Sets every parameter that is a field to its mean over the elements, weighted by volume.
void fill_means(const std::vector<std::size_t>& elements, const TetMesh& mesh, Material& material) {
  std::vector<double> volumes;
  double sum = 0;
  for (const std::size_t t : elements) {
    const Tet& tet = mesh.tets[t];
    const auto X = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    volumes.push_back(signed_volume(X(0), X(1), X(2), X(3)));
    sum += volumes.back();
  }
  if (elements.empty()) return;
  for (const FieldParameter& parameter : material.fields) {
    const std::vector<double>& values = find_field(mesh, parameter.field)->values;
    double mean = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) mean += volumes[i] / sum * values[elements[i]];
    material.parameters.at(parameter.parameter) = mean;
  }
}

}  // namespace

void resolve_fields(const std::string& file, WorldSetup& setup) {
  std::set<std::string> used;
  for (std::size_t i = 0; i < setup.materials.size(); ++i) {
    Material& material = setup.materials[i].material;
    if (!uses_fields(material)) continue;
    const std::vector<std::size_t> elements = elements_of(setup.materials[i].region, setup.materials, setup.mesh);
    Check(material, elements, setup.mesh, file, fmt::format("materials[{}]", i), !setup.midedges.empty()).run();
    fill_means(elements, setup.mesh, material);
    for (const FieldParameter& field : material.fields) used.insert(field.field);
    used.insert(material.fibre_field);
  }
  std::erase_if(setup.mesh.fields, [&](const ElementField& field) { return !used.contains(field.name); });
}

}  // namespace heml
