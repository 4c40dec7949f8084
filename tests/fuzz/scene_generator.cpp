#include "scene_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <heml/materials/material.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/command_table.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/positions_csv.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>
#include <random>

#include "support.hpp"

namespace heml::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double size = 0.1;  // m, of a generated body, which is in [0, size]³
constexpr int generated_ticks = 12;

/// Random choices.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15u + 1) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  bool chance(double p) { return real(0, 1) < p; }
  double real(double low, double high) { return test::uniform(random_, low, high); }
  double magnitude(double low, double high) { return std::pow(10, real(low, high)); }  ///< by its exponent
  template <class List>
  auto pick(const List& list) {
    return std::data(list)[below(static_cast<int>(std::size(list)))];
  }

 private:
  std::mt19937_64 random_;
};

constexpr double odd_numbers[] = {
    0,      -0.0,   1,   -1,   2,    0.5,   -0.5, 1e-30, -1e-30, 1e30, -1e30,        1e300,         1e308,
    1e-300, 5e-324, 1e9, 1e-9, 1e15, -1e15, 1e18, 3,     7,      100,  2147483647.0, -2147483648.0, 9007199254740993.0};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : dice_(seed) {}

  std::string text() {
    Json scene = dice_.chance(0.15) ? shipped() : generated();
    if (dice_.chance(0.35))
      for (int k = 1 + dice_.below(3); k > 0; --k) damage(scene);
    std::string text = scene.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (dice_.chance(0.01)) text.insert(1, "\"mesh\": {},");
    return text;
  }

 private:
  // Values.
  Json odd_value() {
    static const char* const others[] = {"null",
                                         "true",
                                         "false",
                                         "\"\"",
                                         "\"NaN\"",
                                         "\"inf\"",
                                         "[]",
                                         "{}",
                                         "[[]]",
                                         "\"none\"",
                                         "[1, 2, 3]",
                                         "[0, 0, 0]",
                                         "[\"a\"]",
                                         "{\"field\": \"E\"}",
                                         "18446744073709551615",
                                         "-9223372036854775808"};
    if (dice_.chance(0.75)) return dice_.pick(odd_numbers);
    return Json::parse(dice_.pick(others));
  }

  Json vector(double low, double high) { return {dice_.real(low, high), dice_.real(low, high), dice_.real(low, high)}; }

  /// Somewhere about the body: often on the planes in which its nodes and faces are.
  Json point() {
    Json result = Json::array();
    for (int k = 0; k < 3; ++k)
      result.push_back(dice_.chance(0.4) ? size * dice_.below(7) / 6 : dice_.real(-0.3 * size, 1.3 * size));
    return result;
  }

  Json box() {
    const double low = dice_.chance(0.5) ? -1 : dice_.real(-0.1, 1) * size;
    Json lower = {-1, -1, -1}, upper = {1, 1, 1};
    const int axis = dice_.below(3);
    lower[axis] = low;
    upper[axis] = dice_.chance(0.5) ? std::max(low, 1e-6) : low + dice_.real(0, 1) * size;
    return {lower, upper};
  }

  Json value_of(const ValueForm& form) {
    switch (form.kind) {
      case ValueForm::Kind::number:
        return dice_.chance(0.5) ? dice_.real(-1, 1) : (dice_.chance(0.5) ? -1 : 1) * dice_.magnitude(-4, 4);
      case ValueForm::Kind::positive:
        return dice_.magnitude(-5, 5);
      case ValueForm::Kind::non_negative:
        return dice_.chance(0.3) ? 0 : dice_.magnitude(-4, 2);
      case ValueForm::Kind::between:
        return dice_.real(form.low, std::min(form.high, form.low + 1000));
      case ValueForm::Kind::whole:
        return static_cast<long>(form.low) + dice_.below(static_cast<int>(std::min(form.high - form.low, 20.0)) + 1);
      case ValueForm::Kind::flag:
        return dice_.chance(0.5);
      case ValueForm::Kind::text:
        return "text";
      case ValueForm::Kind::vector:
      case ValueForm::Kind::direction:
        return vector(-1, 1);
      case ValueForm::Kind::name:
        return dice_.pick(form.names());
      case ValueForm::Kind::other:
        break;
    }
    return odd_value();
  }

  // Parts of a scene.
  Json mesh() {
    Json mesh;
    if (dice_.chance(0.5)) {
      mesh["box"] = {{"size", {size, size, size}},
                     {"cells", {1 + dice_.below(3), 1 + dice_.below(2), 1 + dice_.below(2)}}};
    } else {
      static const char* const files[] = {"one.mesh",    "face.mesh",   "edge.mesh",    "node.mesh", "apart.mesh",
                                          "orphan.mesh", "sliver.mesh", "regions.mesh", "fields.vtk"};
      stem_ = dice_.pick(files);
      mesh["file"] = stem_;
      stem_.resize(stem_.find('.'));
    }
    if (dice_.chance(0.05)) mesh["scale"] = dice_.magnitude(-6, 6);
    if (dice_.chance(0.1)) mesh["rotate"] = {{"axis", vector(-1, 1)}, {"degrees", dice_.real(-360, 360)}};
    if (dice_.chance(0.05)) mesh["translate"] = vector(-1, 1);
    if (dice_.chance(0.03)) mesh["refine"] = {{"error", dice_.real(0.1, 1)}, {"tets", 1 + dice_.below(100)}};
    return mesh;
  }

  Json material(std::optional<int> region) {
    if (dice_.chance(0.05)) {
      Json json = {{"preset", dice_.pick(presets()).name}};
      if (region) json["region"] = *region;
      return json;
    }
    const LawInfo& law = dice_.pick(laws());
    const double stiffer = dice_.chance(0.7) ? 1 : dice_.magnitude(-3, 4);
    Material sample = sample_material(law, {law.sample.shear * stiffer, law.sample.bulk * stiffer});
    Json json = material_json({region, sample});
    const double common = dice_.chance(0.6) ? 0 : 0.4;
    for (const char* key : {"viscosity", "bulk_viscosity"})
      if (takes_key(law, key) && dice_.chance(common)) json[key] = dice_.magnitude(-2, 3);
    if (takes_key(law, "volume_term")) json["volume_term"] = dice_.pick(volume_term_names());
    if (takes_key(law, "relaxation") && dice_.chance(common))
      for (int k = dice_.below(4); k > 0; --k)
        json["relaxation"].push_back({{"gamma", dice_.magnitude(-2, 1)}, {"tau", dice_.magnitude(-5, 1)}});
    if (takes_key(law, "plasticity") && dice_.chance(common))
      json["plasticity"] = {{"yield", dice_.magnitude(0, 4)}, {"hardening", dice_.below(2) * dice_.magnitude(0, 4)}};
    if (dice_.chance(0.1)) json["density"] = dice_.magnitude(-3, 5);
    if (stem_ == "fields" && law.takes_young_poisson && dice_.chance(0.5)) json["lambda"] = {{"field", "E"}};
    if (stem_ == "fields" && law.has_fibre && dice_.chance(0.5)) json["fibre"] = {{"field", "a"}};
    return json;
  }

  Json selection() {
    switch (dice_.below(5)) {
      case 0:
        return {{"nodes", {dice_.below(4)}}};
      case 1:
        return {{"nodes", {dice_.below(4), dice_.below(8), 0}}};
      case 2:
        return {{"sphere", {point(), dice_.real(0, 1.5) * size}}};
      default:
        return {{"box", box()}};
    }
  }

  Json motion() {
    if (dice_.chance(0.5)) return {{"fix", true}};
    Json json;
    if (dice_.chance(0.7)) json["translate"] = vector(-size, size);
    if (json.is_null() || dice_.chance(0.3))
      json["rotate"] = {{"axis", vector(-1, 1)}, {"degrees", dice_.real(-400, 400)}};
    if (dice_.chance(0.8)) json["over"] = dice_.real(0, 2 * duration_);
    return json;
  }

  Json boundary() {
    Json all = Json::array();
    const int kind = dice_.below(6);  // 0: none
    if (kind == 1) all.push_back({{"box", {{-9, -9, -9}, {9, 9, 9}}}});
    if (kind == 2 || kind == 3) all.push_back({{"box", {{-1, -1, -1}, {1e-9, 1, 1}}}, {"fix", true}});
    if (kind == 3) all.push_back({{"box", {{size - 1e-9, -1, -1}, {1, 1, 1}}}});
    for (int k = kind < 4 ? 0 : kind - 3; k > 0; --k) all.push_back(selection());
    for (Json& entry : all)
      if (!entry.contains("fix")) entry.update(motion());
    return all;
  }

  Json loads() {
    Json all = Json::array();
    for (int k = dice_.below(3); k > 0; --k) {
      Json load = selection();
      const int kind = dice_.below(3);
      if (kind == 0) load["force"] = vector(-1, 1);
      if (kind == 1) load["traction"] = vector(-1000, 1000);
      if (kind == 2) load["pressure"] = dice_.real(-2000, 2000);
      if (dice_.chance(0.5)) load["over"] = dice_.real(0, duration_);
      all.push_back(load);
    }
    return all;
  }

  Json tables() {
    Json all = Json::array();
    for (int k = 1 + dice_.below(2); k > 0; --k)
      all.push_back({{"point", dice_.chance(0.7) ? vector(-0.5 * size, 0) : point()},
                     {"normal", dice_.chance(0.5) ? vector(-1, 1) : Json{0, 1, 0}},
                     {"friction", dice_.below(2) * dice_.real(0, 2)}});
    return all;
  }

  Json solver() {
    Json solver = Json::object();
    for (const KeyInfo& key : keys_of("solver"))
      if (dice_.chance(0.3) && key.form.kind != ValueForm::Kind::other)
        solver[std::string(key.name)] = value_of(key.form);
    const double tick = 1 / (dice_.chance(0.5) ? 100 : dice_.magnitude(1.5, 3.5));
    solver.erase("rate");
    solver.erase("step");
    if (dice_.chance(0.3))
      solver["step"] = tick;
    else
      solver["rate"] = 1 / tick;
    ticks_ = dice_.below(generated_ticks + 1);
    duration_ = tick * ticks_ + (dice_.chance(0.2) ? tick * dice_.real(0, 1) : 0);
    solver["duration"] = duration_;
    solver["integrator"] = dice_.pick(integrator_names());
    solver["threads"] = 1 + dice_.below(2);
    if (solver.contains("tolerance")) solver["tolerance"] = dice_.magnitude(-12, 0);
    if (dice_.chance(0.1))
      solver["budget"] = dice_.chance(0.7) ? Json{{"iterations", 1 + dice_.below(4)}} : Json{{"milliseconds", 0.1}};
    return solver;
  }

  Json outputs() {
    Json outputs = Json::object();
    for (const KeyInfo& key : keys_of("outputs"))
      if (dice_.chance(0.4) && key.form.kind != ValueForm::Kind::other)
        outputs[std::string(key.name)] = value_of(key.form);
    for (int k = dice_.below(4); k > 0; --k) outputs["times"].push_back(dice_.real(0, std::min(duration_, 1.0)));
    if (dice_.chance(0.3)) outputs["markers"] = Json::array({selection()});
    return outputs;
  }

  // Events.
  Json place_of_node() { return dice_.chance(0.5) ? Json{{"node", dice_.below(8)}} : Json{{"point", point()}}; }

  Json release() {
    static const char* const whats[] = {"true", "\"pins\"", "\"probe\"", "\"sutures\""};
    return dice_.chance(0.2) ? place_of_node() : Json::parse(dice_.pick(whats));
  }

  Json patch() {
    Json json = place_of_node();
    if (dice_.chance(0.6)) json["radius"] = dice_.real(0, 1.2) * size;
    return json;
  }

  Json probe() {
    Json path = Json::array();
    for (int k = 1 + dice_.below(3); k > 0; --k) path.push_back(point());
    Json json = {{"radius", dice_.magnitude(-2, 0) * size}, {"path", path}, {"speed", dice_.magnitude(-2, 1)}};
    if (dice_.chance(0.5)) json["shaft"] = vector(-size, size);
    if (dice_.chance(0.5)) json["friction"] = dice_.real(0, 2);
    return json;
  }

  Json suture() {
    Json json = {{"over", dice_.below(2) * dice_.real(0, 0.1)}, {"length", dice_.below(2) * dice_.real(0, size)}};
    if (dice_.chance(0.6))
      json["nodes"] = {dice_.below(4), dice_.below(8)};
    else
      json["points"] = {point(), point()};
    return json;
  }

  Json elements() {
    switch (dice_.below(4)) {
      case 0:
        return {{"tets", {dice_.below(5), dice_.below(2)}}};
      case 1:
        return {{"region", dice_.below(3)}};
      case 2:
        return {{"box", box()}};
      default:
        return {{"sphere", {point(), dice_.real(0, 1) * size}}};
    }
  }

  /// A blade that crosses the body, or one that is degenerate: a point, a line, in one place all the time, outside.
  Json cut() {
    const double at = dice_.chance(0.5) ? size * dice_.below(7) / 6 : dice_.real(0, 1) * size;
    const int axis = dice_.below(3), kind = dice_.below(8);
    const auto corner = [&](double a, double b) {
      Json p = {a, a, a};
      p[axis] = at;
      p[(axis + 1) % 3] = b;
      return p;
    };
    Json sweep = {{corner(-1, -1), corner(-1, 1)}, {corner(1, -1), corner(1, 1)}};  // a whole plane
    if (kind == 0) sweep = {{point(), point()}, {point(), point()}, {point(), point()}};
    if (kind == 1) sweep[1] = sweep[0];
    if (kind == 2) sweep[0][0] = sweep[0][1];
    if (kind == 3) sweep = {{point(), point()}, {point(), point()}};
    if (kind == 4) sweep = {{corner(0, 0), corner(0, size)}, {corner(size, 0), corner(size, size)}};
    if (kind == 5) sweep.push_back({corner(2, -1), corner(2, 1)});
    Json json = {{"sweep", sweep}};
    if (dice_.chance(0.3)) json["goes_on"] = dice_.chance(0.8);
    return json;
  }

  Json region() {
    Json json = elements();
    json["name"] = dice_.chance(0.5) ? "a" : "b";
    if (dice_.chance(0.3)) json["number"] = dice_.below(3);
    if (dice_.chance(0.6)) json["material"] = material(std::nullopt);
    return json;
  }

  Json value_of(const CommandInfo& command) {
    if (command.key == "grasp" || command.key == "pin") return patch();
    if (command.key == "release") return release();
    if (command.key == "move") return point();
    if (command.key == "tables") return tables();
    if (command.key == "probe") return probe();
    if (command.key == "suture") return suture();
    if (command.key == "remove") return elements();
    if (command.key == "cut") return cut();
    if (command.key == "region") return region();
    if (command.key == "reset") return dice_.chance(0.5) ? Json("scene") : Json(true);
    if (command.key == "material") return material(dice_.chance(0.3) ? std::optional(1) : std::nullopt);
    if (command.key == "gravity") return vector(-20, 20);
    return command.form.kind == ValueForm::Kind::other ? Json::parse(command.example) : value_of(command.form);
  }

  Json events() {
    Json all = Json::array();
    for (int k = dice_.below(8); k > 0; --k) {
      const CommandInfo& command = dice_.chance(0.35) ? command_with(dice_.chance(0.6)   ? "cut"
                                                                     : dice_.chance(0.5) ? "remove"
                                                                                         : "undo")
                                                      : command_with(dice_.pick(event_keys()));
      Json value = value_of(command);
      if (k % 2 != 0 && command.key == "grasp") value["hand"] = k;
      if (k % 2 != 0 && command.key == "move") value = {{"to", value}, {"hand", k - 2}};
      all.push_back({{"step", dice_.below(ticks_ + 1)}, {std::string(command.key), std::move(value)}});
    }
    return all;
  }

  Json generated() {
    Json scene = {{"schema_version", 1}, {"mesh", mesh()}, {"solver", solver()}};
    scene["materials"].push_back(material(std::nullopt));
    if (dice_.chance(0.3) || stem_ == "regions") scene["materials"].push_back(material(1));
    if (dice_.chance(0.2)) scene["materials"].push_back(material(2));
    scene["boundary"] = boundary();
    if (dice_.chance(0.4)) scene["loads"] = loads();
    if (dice_.chance(0.2)) {
      scene["regions"] = Json::array({region()});
      scene["regions"][0].erase("material");
    }
    if (dice_.chance(0.3)) scene["tables"] = tables();
    if (dice_.chance(0.3))
      scene["self_contact"] =
          dice_.chance(0.5) ? Json(true) : Json{{"friction", 0.5}, {"within_bodies", dice_.chance(0.5)}};
    if (dice_.chance(0.2)) scene["tearing"] = {{"stretch", 1 + dice_.magnitude(-3, 0)}};
    if (dice_.chance(0.5)) scene["gravity"] = vector(-20, 20);
    if (dice_.chance(0.4)) scene["outputs"] = outputs();
    if (dice_.chance(0.2)) scene["initial"]["velocity"] = vector(-2, 2);
    if (!stem_.empty() && dice_.chance(0.1))
      scene["initial"]["positions"] = stem_ + (dice_.chance(0.5) ? "_flat.csv" : "_mirrored.csv");
    if (dice_.chance(0.7)) scene["events"] = events();
    return scene;
  }

  /// A shipped scene on a small mesh, with its events in its first ticks.
  Json shipped() {
    static const std::vector<fs::path> files = [] {
      std::vector<fs::path> found;
      for (const char* folder : {"scenes", "scenes/extreme"})
        for (const auto& entry : fs::directory_iterator(assets_folder() / folder))
          if (entry.path().extension() == ".json") found.push_back(entry.path());
      std::sort(found.begin(), found.end());
      return found;
    }();
    const fs::path file = dice_.pick(files);
    std::ifstream in(file);
    Json scene = Json::parse(in);
    Json& mesh = scene["mesh"];
    int cells = 1;
    if (mesh.contains("box"))
      for (Json& n : mesh["box"]["cells"]) cells *= n.get<int>();
    if (!mesh.contains("box")) mesh = {{"box", {{"size", {size, size, size}}, {"cells", {3, 1, 1}}}}};
    if (cells > 24) mesh["box"]["cells"] = {3, 2, 1};
    if (scene.contains("initial") && scene["initial"].contains("positions")) {
      const std::string csv = scene["initial"]["positions"];
      scene["initial"]["positions"] = (file.parent_path() / csv).string();
    }
    Json& solver = scene["solver"];
    const double tick = solver.contains("step") ? solver["step"].get<double>() : 1 / solver.value("rate", 100.0);
    solver["duration"] = 5 * tick;
    solver["threads"] = 1;
    if (scene.contains("outputs")) scene["outputs"].erase("times");
    if (scene.contains("events"))
      for (Json& event : scene["events"]) {
        event.erase("at");
        event["step"] = dice_.below(5);
      }
    return scene;
  }

  // Damage.
  static void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
      for (Json& part : value) collect(part, all);
  }

  void damage(Json& scene) {
    std::vector<Json*> all;
    collect(scene, all);
    Json& value = *all[static_cast<std::size_t>(1 + dice_.below(static_cast<int>(all.size()) - 1))];
    switch (dice_.below(8)) {
      case 0:
        if (value.is_object() && !value.empty())
          value.erase(std::next(value.begin(), dice_.below(static_cast<int>(value.size()))));
        break;
      case 1:
        if (value.is_array() && !value.empty()) value.erase(value.begin());
        break;
      case 2:
        if (value.is_array() && !value.empty())
          for (int k = dice_.chance(0.1) ? 1000 : 1; k > 0; --k) value.push_back(Json(value.front()));
        break;
      case 3:
        value = Json(*all[static_cast<std::size_t>(dice_.below(static_cast<int>(all.size())))]);
        break;
      default:
        if (value.is_number() || dice_.chance(0.2)) value = odd_value();
    }
  }

  Dice dice_;
  std::string stem_;  ///< of the mesh file; empty: a box
  double duration_ = 0;
  int ticks_ = 0;
};

TetMesh mesh_of(std::vector<Vec3> nodes, std::vector<Tet> tets) {
  for (Vec3& node : nodes) node *= size;
  std::vector<int> regions(tets.size(), 0);
  return {std::move(nodes), std::move(tets), std::move(regions), "generated"};
}

}  // namespace

std::string scene_of_seed(std::uint64_t seed) { return Generator(seed).text(); }

void write_small_meshes(const fs::path& folder) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), xyz(1, 1, 1), xy(1, 1, 0);
  const auto write = [&](const char* name, const TetMesh& mesh) {
    const fs::path path = folder / name;
    write_tet_mesh(path, mesh);
    std::vector<Vec3> flat = mesh.nodes, mirrored = mesh.nodes;
    for (Vec3& node : flat) node.z() = 0;
    for (Vec3& node : mirrored) node.x() = -node.x();
    write_positions_csv(folder / (path.stem().string() + "_flat.csv"), flat);
    write_positions_csv(folder / (path.stem().string() + "_mirrored.csv"), mirrored);
  };
  write("one.mesh", mesh_of({o, x, y, z}, {{0, 1, 2, 3}}));
  write("face.mesh", mesh_of({o, x, y, z, xyz}, {{0, 1, 2, 3}, {1, 2, 3, 4}}));
  write("edge.mesh", mesh_of({o, x, y, z, xyz, xy}, {{0, 1, 2, 3}, {1, 2, 5, 4}}));
  write("node.mesh", mesh_of({o, x, y, z, -x, -y, -z}, {{0, 1, 2, 3}, {0, 4, 6, 5}}));
  write("apart.mesh", mesh_of({o, x, y, z, 2 * x, 3 * x, 2 * x + y, 2 * x + z}, {{0, 1, 2, 3}, {4, 5, 6, 7}}));
  write("orphan.mesh", mesh_of({o, x, y, z, xyz, xy}, {{0, 1, 2, 3}}));
  write("sliver.mesh", mesh_of({o, x, y, z, xy + 1e-4 * z}, {{0, 1, 2, 3}, {0, 2, 1, 4}}));
  TetMesh box = make_box(Vec3(size, size, size), {2, 1, 1});
  for (std::size_t t = 0; t < box.tets.size(); ++t) box.regions[t] = t < box.tets.size() / 2 ? 1 : 2;
  write("regions.mesh", box);
  ElementField young{"E", 1, {}}, fibre{"a", 3, {}};
  for (std::size_t t = 0; t < box.tets.size(); ++t) {
    young.values.push_back(1e4 * static_cast<double>(t + 1));
    fibre.values.insert(fibre.values.end(), {1, 0.1 * static_cast<double>(t), 0});
  }
  box.fields = {young, fibre};
  write("fields.vtk", box);
}

}  // namespace heml::fuzz
