#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/log.hpp>
#include <heml/mesh/file_contents.hpp>
#include <heml/mesh/readers.hpp>
#include <heml/mesh/xml_values.hpp>
#include <heml/scenario/feb_material.hpp>
#include <heml/scenario/feb_model.hpp>
#include <heml/scenario/feb_scene.hpp>
#include <heml/scenario/selection.hpp>
#include <heml/scenario/solver_json.hpp>
#include <heml/scenario/text_file.hpp>

namespace heml {
namespace {

constexpr double largest_room = 5;  // m
constexpr std::string_view read_sections[] = {"Module",   "Control", "Material", "Geometry", "Mesh", "MeshDomains",
                                              "Boundary", "Loads",   "Contact",  "LoadData", "Step"};
constexpr std::string_view harmless_sections[] = {"Globals", "Output", "MeshData"};

/// Systems of units that FEBio Studio writes, with seconds.
const FebUnits known_units[] = {
    {"SI", 1, 1},        {"mm-N-s", 1e-3, 1},    {"mm-kg-s", 1e-3, 1e-3}, {"um-nN-s", 1e-6, 1e-9},
    {"CGS", 1e-2, 1e-5}, {"mm-g-s", 1e-3, 1e-6}, {"mm-mg-s", 1e-3, 1e-9}};

template <std::size_t count>
bool is_one_of(const std::string_view (&names)[count], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// A file has its step's sections directly in <Step> (2.5), or in <Step><step>.
void find_step(FebModel& model) {
  for (const XmlElement step : model.root.children()) {
    if (step.name() != "Step") continue;
    const bool nested = step.child("step").has_value();
    for (const XmlElement child : step.children()) {
      if (nested && model.step && !(*model.step == step))
        model.findings.refuse(child, "a further step: heml computes one");
      else if (nested)
        model.step = child;
    }
    if (!nested && model.step) model.findings.refuse(step, "a further step: heml computes one");
    if (!nested) model.step = step;
  }
}

void check_sections(FebModel& model) {
  const auto check = [&](const XmlElement& parent) {
    for (const XmlElement section : parent.children()) {
      if (section.attribute("from") || section.name() == "Include")
        section.fail("another file is included", "put its lines here in place of this");
      if (is_one_of(read_sections, section.name())) continue;
      const std::string name = feb_tag(section);
      const bool empty = section.text().empty() && !(section.children().begin() != section.children().end());
      if (is_one_of(harmless_sections, section.name()))
        model.findings.note(
            section,
            name + " is not read" + (section.name() == "MeshData" ? ": nothing that is read has values of it" : ""));
      else if (!empty)
        model.findings.refuse(section, name + " is not known");
    }
  };
  check(model.root);
  if (model.step) check(*model.step);
  for (const XmlElement& unread : model.mesh.unread) model.findings.note(unread, feb_name(unread) + " is not read");
}

void read_module(FebModel& model, const BareMeshOptions& options) {
  for (const XmlElement& module : model.sections("Module")) {
    if (const std::string type = module.attribute("type").value_or("solid"); type != "solid")
      model.findings.refuse(module, fmt::format("the module is {}; heml computes solids", plain_name(type)));
    const auto units = module.child("units");
    if (!units || units->text().empty()) continue;
    const auto known = std::find_if(std::begin(known_units), std::end(known_units),
                                    [&](const FebUnits& each) { return each.name == units->text(); });
    if (known == std::end(known_units))
      model.findings.refuse(*units, fmt::format("the units '{}' are not known", plain_name(units->text())));
    else
      model.units = *known;
  }
  if (options.unit) model.units = {options.unit->name, options.unit->scale, 1};
}

void read_control(FebModel& model) {
  double steps = 10;
  for (const XmlElement& control : model.sections("Control")) {
    if (const auto count = control.child("time_steps")) steps = number_in(*count, count->text(), "<time_steps>");
    if (const auto size = control.child("step_size"))
      model.control.step = number_in(*size, size->text(), "<step_size>");
    if (const auto analysis = control.child("analysis")) {
      const std::string kind = lower_case(analysis->attribute("type").value_or(std::string(analysis->text())));
      model.control.dynamic = kind == "dynamic" || kind == "1";
      if (!model.control.dynamic && kind != "static" && kind != "steady-state" && kind != "0")
        model.findings.refuse(*analysis, fmt::format("the analysis is '{}'", plain_name(kind)));
    }
    model.control.end = steps * model.control.step;
    if (!(steps >= 1) || !(model.control.step > 0) || !std::isfinite(model.control.end))
      control.fail(fmt::format("{} time steps of {} s", steps, model.control.step), "one or more, longer than 0");
  }
}

bool is_computed(const FebPart& part) { return part.element == "tet4" || part.element == "tet10" || part.divided; }

bool has_divided(const FebModel& model) {
  return std::any_of(model.mesh.parts.begin(), model.mesh.parts.end(),
                     [](const FebPart& part) { return part.divided; });
}

void check_parts(FebModel& model) {
  for (const FebPart& part : model.mesh.parts) {
    const std::string formulation = part.domain ? part.domain->attribute_or_empty("type") : "";
    if (!formulation.empty() && formulation != "elastic-solid")
      model.findings.refuse(*part.domain,
                            fmt::format("part '{}' is of the formulation '{}'; heml's elements are those of "
                                        "elastic-solid",
                                        part.name, plain_name(formulation)));
  }
  for (const FebPart& part : model.mesh.parts) {
    if (!is_computed(part))
      model.findings.refuse(part.tag, fmt::format("part '{}' is of {} elements; heml computes tet4, tet10, and "
                                                  "divides hex8, penta6 and pyra5: mesh it with these",
                                                  part.name, part.element.empty() ? "unnamed" : part.element));
    else if (part.divided)
      model.findings.note(part.tag, fmt::format("part '{}' is of {} elements: each is divided into tetrahedra, here "
                                                "quadratic ones (\"element\": \"p2\")",
                                                part.name, part.element));
  }
  const auto has = [&](const char* element) {
    return std::any_of(model.mesh.parts.begin(), model.mesh.parts.end(),
                       [&](const FebPart& part) { return part.element == element; });
  };
  if (has("tet10") && (has("tet4") || has_divided(model)))
    model.findings.refuse(model.mesh.parts.front().tag, "tet10 and other elements in one body");
}

std::optional<XmlElement> material_element(const FebModel& model, const FebPart& part) {
  std::optional<XmlElement> by_id;
  for (const XmlElement& section : model.sections("Material"))
    for (const XmlElement material : section.children()) {
      if (material.attribute("name") == part.material) return material;
      if (material.attribute("id") == part.material) by_id = material;
    }
  return by_id;
}

void read_materials(FebModel& model, Scene& scene) {
  for (std::size_t k = 0; k < model.mesh.parts.size(); ++k) {
    const FebPart& part = model.mesh.parts[k];
    if (!is_computed(part)) continue;
    const auto element = material_element(model, part);
    if (!element) {
      model.findings.refuse(part.tag, fmt::format("part '{}' has no material{}", part.name,
                                                  part.material.empty() ? "" : " '" + plain_name(part.material) + "'"));
      continue;
    }
    if (const auto material = feb_material(*element, model.units, model.findings))
      scene.materials.push_back({static_cast<int>(k) + 1, *material});
  }
}

bool is_sliding(std::string_view type) { return type.starts_with("sliding") || type == "facet-to-facet sliding"; }

/// heml's self-contact is of the whole surface, with one coefficient of friction.
void read_contact(FebModel& model, Scene& scene) {
  std::optional<double> friction;
  for (const XmlElement& section : model.sections("Contact"))
    for (const XmlElement contact : section.children()) {
      if (!is_sliding(contact.attribute_or_empty("type"))) {
        model.findings.refuse(contact, feb_name(contact) + " is not known (known: sliding contacts)");
        continue;
      }
      if (const auto tension = contact.child("tension"); tension && tension->text() != "0") {
        model.findings.refuse(contact, feb_name(contact) + " sticks together (tension)");
        continue;
      }
      const auto coefficient = contact.child("fric_coeff");
      const double mu = coefficient ? number_in(*coefficient, coefficient->text(), "<fric_coeff>") : 0;
      if (mu < 0 || (friction && *friction != mu))
        model.findings.refuse(contact, fmt::format("{} has friction {}; heml has one coefficient ≥ 0 for all contacts",
                                                   feb_name(contact), mu));
      else
        model.findings.note(
            contact, feb_name(contact) + " becomes self-contact of the whole surface, without penalties of its own");
      friction = mu;
    }
  if (!friction) return;
  scene.self_contact = SelfContactSettings{*friction};
}

void set_method(FebModel& model, Scene& scene) {
  SolverSettings& solver = scene.solver;
  solver.duration = model.control.end;
  const bool of_ten_nodes =
      !model.mesh.read.midedges.empty() && std::all_of(model.mesh.parts.begin(), model.mesh.parts.end(),
                                                       [](const FebPart& part) { return part.element == "tet10"; });
  if (of_ten_nodes) model.findings.note(model.mesh.parts.front().tag, "tet10 elements: \"element\": \"p2\"");
  solver.quadratic = of_ten_nodes || (has_divided(model) && model.mesh.read.midedges.empty());
  if (!model.control.dynamic) {
    solver.integrator = Integrator::static_equilibrium;
    solver.rate = default_rate(solver.integrator);
    return;
  }
  solver.integrator = Integrator::tr_bdf2;
  const double rate = 1 / model.control.step;
  if (rate >= 1 && rate <= 1e6)
    solver.rate = rate;
  else
    solver.step = model.control.step;
  if (const auto control = model.sections("Control"); !control.empty())
    model.findings.note(control.front(),
                        fmt::format("dynamics are computed by TR-BDF2 in steps of {} s, with masses lumped at nodes",
                                    model.control.step));
}

/// In statics all grows together: where the file has it otherwise, the way to the end differs.
void tell_courses(FebModel& model) {
  const auto load_data = model.sections("LoadData");
  if (model.control.dynamic || load_data.empty()) return;
  if (model.courses.size() > 1 || model.courses.contains(-1))
    model.findings.note(
        load_data.front(),
        fmt::format("the load curves do not all grow linearly over the same time; heml's statics let all "
                    "values grow together to those at {} s: the end is the same, the way to it is not",
                    model.control.end));
}

void tell_notes(const FebModel& model, const Scene& scene) {
  for (const std::string& note : model.findings.notes()) warn("{}: {}", scene.file, note);
  const auto [low, high] = bounds_of(model.mesh.read.mesh.nodes);
  const double length = model.units.length * (high - low).maxCoeff();
  if (length > largest_room)
    warn(
        "{}: {:.3g} m long, larger than a room: FEBio's files have no unit, this one is read in {}. If it is in "
        "millimetres, newtons and megapascals, write <Module type=\"solid\"><units>mm-N-s</units></Module>",
        scene.file, length, model.units.name);
}

}  // namespace

std::vector<XmlElement> FebModel::sections(std::string_view name) const {
  std::vector<XmlElement> found;
  for (const XmlElement section : root.children())
    if (section.name() == name) found.push_back(section);
  if (step)
    for (const XmlElement section : step->children())
      if (section.name() == name) found.push_back(section);
  return found;
}

FebFactor FebModel::factor_of(const XmlElement& value) {
  const FebFactor factor = curves.factor_of(value, findings);
  courses.insert(factor.ramp_time.value_or(-1));
  if (control.dynamic && !factor.ramp_time)
    findings.refuse(value, fmt::format("<{}> does not grow linearly from 0 and then stay, by its load curve; in "
                                       "dynamics heml has ramps alone",
                                       value.name()));
  return factor;
}

std::optional<std::vector<int>> FebModel::nodes_of(const XmlElement& element, const char* key) {
  constexpr std::string_view of_surface = "@surface:";
  const std::string name = element.attribute_or_empty(key);
  std::vector<int> nodes;
  const bool is_surface = name.starts_with(of_surface) || std::string_view(key) == "surface";
  if (const auto set = mesh.node_sets.find(name); set != mesh.node_sets.end() && !is_surface) {
    nodes = set->second;
  } else if (is_surface) {
    const auto surface = mesh.surfaces.find(name.starts_with(of_surface) ? name.substr(of_surface.size()) : name);
    if (surface != mesh.surfaces.end() && !surface->second.has_other_facets) nodes = surface->second.nodes;
  }
  if (!nodes.empty()) return nodes;
  findings.refuse(element, fmt::format("{} names the {} '{}', which is not given, is empty or is of another kind",
                                       feb_name(element), key, plain_name(name)));
  return std::nullopt;
}

bool is_feb_file(const std::filesystem::path& path) { return lower_case(path.extension().string()) == ".feb"; }

Scene scene_from_feb(const std::filesystem::path& path, const BareMeshOptions& options) {
  const std::string text = file_contents(path);
  const XmlDocument document(path.string(), text);
  const XmlElement root = feb_root(document);
  FebModel model(root);
  Scene scene;
  scene.file = path.string();
  scene.name = path.stem().string();
  scene.mesh.file = path;
  find_step(model);
  check_sections(model);
  read_module(model, options);
  scene.mesh.scale = model.units.length;
  read_control(model);
  model.curves = FebCurves(model.sections("LoadData"), model.control.end);
  check_parts(model);
  set_method(model, scene);
  read_materials(model, scene);
  read_feb_boundary(model, scene);
  read_feb_loads(model, scene);
  read_contact(model, scene);
  tell_courses(model);
  model.findings.throw_refused(scene.file);
  if (model.mesh.read.mesh.tets.empty()) root.fail("the mesh holds no tetrahedra");
  tell_notes(model, scene);
  return scene;
}

}  // namespace heml
