// A scene from JSON text: one document, or JSON Lines (first line the scene, then one entry of its script a line).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/labels/label_map.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/energy_json.hpp>
#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/event_json.hpp>
#include <heml/scenario/feb_scene.hpp>
#include <heml/scenario/file_kind.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/solver_json.hpp>
#include <heml/scenario/text_file.hpp>
#include <heml/scenario/view_json.hpp>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr long schema_version = 1;
constexpr std::string_view surface_endings[] = {".obj", ".stl",  ".ply", ".off", ".dae",
                                                ".fbx", ".gltf", ".glb", ".3ds"};

void check_version(const JsonCursor& scene) {
  if (!scene.json().is_object()) scene.refuse("must be a scene: an object { ... }");
  const auto version = scene.find("schema_version");
  if (!version) scene.fail("'schema_version' is missing", "add \"schema_version\": 1");
  if (!version->json().is_number_integer() || version->json() != schema_version)
    version->refuse("this build reads version 1");
}

std::vector<RegionMaterial> materials_from(const JsonCursor& key) {
  std::vector<RegionMaterial> materials;
  key.each([&](const JsonCursor& entry) {
    RegionMaterial material = material_from(entry);
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (materials[i].region != material.region) continue;
      const std::string region = material.region ? fmt::format("region {}", *material.region) : "no region";
      entry.fail(fmt::format("is for {}, like materials[{}]", region, i), "keep one, or give it another region");
    }
    materials.push_back(std::move(material));
  });
  if (materials.empty()) key.fail("is empty", "give at least one material");
  return materials;
}

void read_outputs(const JsonCursor& key, Scene& scene) {
  const ObjectReader object(key, keys_of("outputs"));
  if (const auto times = object.find("times")) {
    times->each([&](const JsonCursor& time) {
      scene.output_times.push_back(time.non_negative());
      if (scene.solver.is_static() ? time.number() > 1 : time.number() > scene.solver.duration)
        time.refuse(scene.solver.is_static()
                        ? "in a static scene times are fractions of the load, at most 1"
                        : fmt::format("must be at most solver.duration, {} s", scene.solver.duration));
    });
  }
  object.read("positions", scene.output_positions);
  object.read("vtu", scene.output_vtu);
  if (const auto markers = object.find("markers"))
    markers->each([&](const JsonCursor& entry) { scene.markers.push_back(marker_from(entry)); });
  object.read("history", scene.output_history);
  object.read("every", scene.output_every);
}

void read_initial(const JsonCursor& key, const fs::path& folder, Scene& scene) {
  const ObjectReader object(key, keys_of("initial"));
  object.read("velocity", scene.initial_velocity);
  if (const auto positions = object.find("positions")) scene.initial_positions = path_from(*positions, folder);
}

MeshFingerprint identity_from(const ObjectReader& recorded) {
  const int nodes = recorded.get<int>("nodes"), tets = recorded.get<int>("tets");
  return {nodes, tets, recorded["mesh"].hash()};
}

/// Of a recording from before they were told: none.
std::optional<InstructionSet> instructions_from(const ObjectReader& recorded) {
  const auto key = recorded.find("instructions");
  if (!key) return std::nullopt;
  const std::string name = key->text();
  for (const InstructionSet isa : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512})
    if (name == name_of(isa)) return isa;
  key->fail(fmt::format("\"{}\" is no instruction set", name), "give portable, avx2 or avx512");
}

RecordedBy recorded_by_from(const ObjectReader& recorded) {
  RecordedBy by;
  recorded.read("format", by.format);
  recorded.read("kernel_revision", by.kernel_revision);
  recorded.read("build", by.build);
  return by;
}

/// Everything but the script.
Scene scene_from(const JsonCursor& key, const fs::path& folder) {
  check_version(key);
  const ObjectReader object(key, keys_of(""));
  Scene scene;
  scene.file = key.file();
  object.read("name", scene.name);
  object.read("title", scene.title);
  object.read("description", scene.description);
  scene.mesh = mesh_from(object["mesh"], folder);
  scene.materials = materials_from(object["materials"]);
  if (const auto regions = object.find("regions"))
    regions->each([&](const JsonCursor& entry) {
      scene.regions.push_back(region_tag_from(entry, keys_of("regions[]")));
    });
  if (const auto boundary = object.find("boundary"))
    boundary->each([&](const JsonCursor& entry) { scene.boundary.push_back(boundary_from(entry)); });
  if (const auto loads = object.find("loads"))
    loads->each([&](const JsonCursor& entry) { scene.loads.push_back(load_from(entry)); });
  if (const auto tables = object.find("tables")) scene.tables = tables_from(*tables);
  if (const auto contact = object.find("self_contact")) scene.self_contact = self_contact_from(*contact);
  if (const auto tearing = object.find("tearing")) scene.tearing = tearing_from(*tearing);
  object.read("gravity", scene.gravity);
  if (const auto solver = object.find("solver")) scene.solver = solver_from(*solver);
  if (const auto outputs = object.find("outputs")) read_outputs(*outputs, scene);
  if (const auto initial = object.find("initial")) read_initial(*initial, folder, scene);
  if (const auto skin = object.find("skin")) scene.skin = skin_from(*skin, folder);
  if (const auto view = object.find("view")) scene.view = view_from(*view);
  if (const auto recorded = object.find("recorded")) {
    const ObjectReader made(*recorded, keys_of("recorded"));
    scene.recorded_mesh = identity_from(made);
    scene.recorded_instructions = instructions_from(made);
    scene.recorded_by = recorded_by_from(made);
  }
  return scene;
}

/// Plastic flow and tears depend on the way taken, which statics does not follow.
void check_static(const Scene& scene) {
  if (!scene.solver.is_static()) return;
  if (scene.tearing)
    throw InputError(scene.file, "tearing", "does not go with solver.integrator static",
                     "use backward_euler with loads ramped over a time");
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (scene.materials[m].material.plasticity)
      throw InputError(scene.file, fmt::format("materials[{}].plasticity", m),
                       "does not go with solver.integrator static", "use backward_euler with loads ramped over a time");
}

/// A law by expression has no continuation, and a body of it starts at rest.
void check_energy_laws(const Scene& scene) {
  const auto check = [&](const Material& material, const std::string& place) {
    if (const std::string problem = energy_setup_problem(material, scene.solver.continuation); !problem.empty())
      throw InputError(
          scene.file, place + ".law", problem,
          scene.solver.continuation ? "take another law, or \"continuation\": false" : "change the expression");
  };
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    check(scene.materials[i].material, fmt::format("materials[{}]", i));
  for (const Event& event : scene.events)
    if (const SetMaterial* set = std::get_if<SetMaterial>(&event.command))
      check(set->material, fmt::format("events: step {}: material", event.tick));
}

/// Quadratic elements take no springs and no tearing.
void check_quadratic(const Scene& scene) {
  if (!scene.solver.quadratic) return;
  const auto refuse = [&](const std::string& place) {
    throw InputError(scene.file, place, fmt::format("does not go with solver.element {}", scene.solver.element()),
                     "take \"element\": \"p1\"");
  };
  if (scene.tearing) refuse("tearing");
  const auto check = [&](const Material& material, const std::string& place) {
    if (!find_law(material.law)->is_continuum) refuse(place + ".law");
  };
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    check(scene.materials[i].material, fmt::format("materials[{}]", i));
  for (const Event& event : scene.events)
    if (const SetMaterial* set = std::get_if<SetMaterial>(&event.command))
      check(set->material, fmt::format("events: step {}: material", event.tick));
}

/// Averaged nodal pressure takes the volume terms of all materials together, mean dilatation one an element.
void check_nodal_pressure(const Scene& scene) {
  if (!scene.solver.nodal_pressure) return;
  const VolumeTerm first = scene.materials.front().material.volume_term;
  const auto check = [&](const Material& material, const std::string& place) {
    if (!find_law(material.law)->has_volume_term)
      throw InputError(scene.file, place + ".law",
                       fmt::format("'{}' has no volume term of its own, which solver.element {} needs",
                                   find_law(material.law)->name, scene.solver.element()),
                       fmt::format("take another law, or \"element\": \"{}\"", scene.solver.quadratic ? "p2" : "p1"));
    if (material.volume_term != first && !scene.solver.quadratic)
      throw InputError(scene.file, place + ".volume_term", "differs from that of materials[0]",
                       "solver.element nodal_pressure needs the same in all materials");
  };
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    check(scene.materials[i].material, fmt::format("materials[{}]", i));
  for (const Event& event : scene.events)
    if (const SetMaterial* set = std::get_if<SetMaterial>(&event.command))
      check(set->material, fmt::format("events: step {}: material", event.tick));
}

/// The script that stands in the scene's own object.
void read_lists(const JsonCursor& key, double tick_length, Script& script) {
  for (const std::string_view name : {"events", "checkpoints"})
    if (const auto entries = key.find(name))
      entries->each([&](const JsonCursor& entry) { read_script_entry(entry, tick_length, script); });
}

/// The lines after the first. A last line cut off is what a crash in the middle of writing leaves: it is dropped. After
/// the end nothing is written, so nothing may stand there.
void read_lines(std::string_view text, const std::string& file, double tick_length, Script& script) {
  for (long line = 2; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view entry = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (is_blank(entry)) continue;
    const bool ended = script.end.has_value();
    if (end == text.npos && !ended && !Json::accept(entry)) {
      warn("{}: line {}: cut off in the middle; the recording is read up to there", file, line);
      return;
    }
    const Json json = parse_json(entry, file, line);
    const JsonCursor key(json, file, fmt::format("line {}", line));
    read_script_entry(key, tick_length, script);
    if (ended) key.fail("stands after the end", "the end is the last line: take this one away");
  }
}

/// Whether a text is JSON Lines: its first line is a value by itself and something follows.
bool is_json_lines(std::string_view text) {
  const std::size_t end = text.find('\n');
  return end != text.npos && !is_blank(text.substr(end)) && Json::accept(text.substr(0, end));
}

bool looks_like_json(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '{';
}

}  // namespace

Scene parse_scene(std::string_view text, const fs::path& as_if_from) {
  const std::string file = as_if_from.string();
  if (is_blank(text)) throw InputError(file, "", "is empty", "give a scene or a recording");
  const std::size_t end = is_json_lines(text) ? text.find('\n') : text.size();
  const Json document = parse_json(text.substr(0, end), file);
  const JsonCursor key(document, file);
  Scene scene = scene_from(key, as_if_from.parent_path());
  Script script;
  read_lists(key, scene.solver.tick(), script);
  if (end < text.size()) read_lines(text.substr(end + 1), file, scene.solver.tick(), script);
  install_script(std::move(script), scene);
  check_nodal_pressure(scene);
  check_energy_laws(scene);
  check_quadratic(scene);
  check_static(scene);
  return scene;
}

FileKind kind_of(const fs::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".json" || is_feb_file(path)) return FileKind::scene;
  if (ending == ".jsonl") return FileKind::recording;
  if (is_tet_mesh_file(path)) return FileKind::tetrahedra;
  if (is_label_map_file(path)) return FileKind::labels;
  const auto surface = std::find(std::begin(surface_endings), std::end(surface_endings), ending);
  return surface != std::end(surface_endings) ? FileKind::surface : FileKind::other;
}

Scene read_scene(const fs::path& path, const BareMeshOptions& options) {
  if (path.empty()) throw InputError("", "SCENE", "is empty", "give the path or the name of a scene");
  if (is_feb_file(path)) return scene_from_feb(path, options);
  const FileKind kind = kind_of(path);
  if (kind == FileKind::surface || kind == FileKind::tetrahedra || kind == FileKind::labels)
    return scene_around(path, options);
  const std::string text = read_text_file(path);
  if (kind == FileKind::other && !looks_like_json(text))
    throw InputError(path.string(), "", "is not a kind of file this program opens",
                     fmt::format("a scene (.json), a recording (.jsonl), a model of FEBio (.feb), "
                                 "tetrahedra (.msh .mesh .vtk .vtu .inp .node .ele), "
                                 "a label map (.nii .nii.gz .nrrd .nhdr .mha .mhd) or a surface ({})",
                                 fmt::join(surface_endings, " ")));
  return parse_scene(text, path);
}

Material read_material(const fs::path& path) {
  const Json document = parse_json(read_text_file(path), path.string());
  return lone_material_from(JsonCursor(document, path.string()));
}

}  // namespace heml
