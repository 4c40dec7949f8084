#include <fmt/format.h>

#include <algorithm>
#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>

namespace heml {
namespace {

constexpr double max_cells = 2e6;  // ten million tetrahedra

MeshSpec::Box box_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("mesh.box"));
  MeshSpec::Box box{object.get<Vec3>("size"), Vec3::Zero(), {}};
  if (!(box.size.minCoeff() > 0)) key["size"].refuse("must be greater than 0 along x, y and z");
  const JsonCursor cells = object["cells"];
  if (cells.size() != 3) cells.refuse("must be three whole numbers [nx, ny, nz]");
  double product = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    box.cells[i] = static_cast<int>(cells[i].integer(1, static_cast<long>(max_cells)));
    product *= box.cells[i];
  }
  if (product > max_cells) cells.refuse(fmt::format("must be at most {} cells in all", max_cells));
  object.read("origin", box.origin);
  return box;
}

void read_tetgen(const JsonCursor& key, MeshSpec& mesh) {
  const ObjectReader object(key, keys_of("mesh.tetgen"));
  object.read("radius_edge_ratio", mesh.radius_edge_ratio);
  object.read("max_volume", mesh.max_volume);
}

RefineGoal refine_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("mesh.refine"));
  RefineGoal goal;
  object.read("error", goal.error);
  object.read("tets", goal.tets);
  return goal;
}

/// The name of a mesh in the assets folder; refuses names that could lead out of the folder.
std::string asset_from(const JsonCursor& key) {
  const std::string name = key.text();
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](unsigned char c) { return (c < 0x80 && std::isalnum(c)) || c == '_' || c == '-'; });
  if (name.empty() || !plain) key.refuse("must be the name of a mesh that comes with the program, like \"kidney\"");
  return name;
}

}  // namespace

std::filesystem::path path_from(const JsonCursor& key, const std::filesystem::path& folder) {
  const std::string text = key.text();
  if (text.empty() || text.find('\0') != std::string::npos) key.refuse("must be the path of a file");
  return folder / text;  // an absolute path replaces the folder
}

std::string path_text(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::absolute(path, ignored).lexically_normal();
  if (folder.empty()) return whole.string();
  const std::filesystem::path relative =
      whole.lexically_relative(std::filesystem::absolute(folder, ignored).lexically_normal());
  return relative.empty() || *relative.begin() == ".." ? whole.string() : relative.string();
}

MeshSpec mesh_from(const JsonCursor& key, const std::filesystem::path& folder) {
  const ObjectReader object(key, keys_of("mesh"));
  MeshSpec mesh;
  const std::string kind = key.only_one_of({"file", "surface", "labels", "box", "asset"});
  if (kind == "file") mesh.file = path_from(key["file"], folder);
  if (kind == "surface") mesh.surface = path_from(key["surface"], folder);
  if (kind == "labels") mesh.labels = path_from(key["labels"], folder);
  if (kind == "box") mesh.box = box_from(key["box"]);
  if (kind == "asset") mesh.asset = asset_from(key["asset"]);
  if (const auto tetgen = object.find("tetgen")) {
    if (kind != "surface") tetgen->fail("goes with a surface", "take it away, or give mesh.surface");
    read_tetgen(*tetgen, mesh);
  }
  if (const auto tets = object.find("tets")) {
    if (kind == "box" || kind == "asset")
      tets->fail("goes with a file, a surface or a label map", "take it away, or give mesh.file");
    if (kind == "labels")
      object.read("tets", mesh.label_tets);
    else
      object.read("tets", mesh.tets);
  }
  object.read("scale", mesh.scale);
  if (const auto rotate = object.find("rotate"))
    read_rotation(*rotate, mesh.rotate_axis, mesh.rotate_origin, mesh.rotate_degrees);
  object.read("translate", mesh.translate);
  if (const auto refine = object.find("refine")) mesh.refine = refine_from(*refine);
  return mesh;
}

Json mesh_json(const MeshSpec& mesh, const std::filesystem::path& folder) {
  Json json;
  if (!mesh.file.empty()) {
    json["file"] = path_text(mesh.file, folder);
  } else if (!mesh.surface.empty()) {
    json["surface"] = path_text(mesh.surface, folder);
    json["tetgen"] = {{"radius_edge_ratio", mesh.radius_edge_ratio}};
    if (mesh.max_volume) json["tetgen"]["max_volume"] = *mesh.max_volume;
  } else if (!mesh.labels.empty()) {
    json["labels"] = path_text(mesh.labels, folder);
    json["tets"] = mesh.label_tets;
  } else if (mesh.box) {
    json["box"] = {
        {"size", vector_json(mesh.box->size)}, {"cells", mesh.box->cells}, {"origin", vector_json(mesh.box->origin)}};
  } else {
    json["asset"] = mesh.asset;
  }
  if (mesh.tets) json["tets"] = *mesh.tets;
  json["scale"] = mesh.scale;
  json["rotate"] = rotation_json(mesh.rotate_axis, mesh.rotate_origin, mesh.rotate_degrees);
  json["translate"] = vector_json(mesh.translate);
  if (mesh.refine) json["refine"] = {{"error", mesh.refine->error}, {"tets", mesh.refine->tets}};
  return json;
}

void read_rotation(const JsonCursor& key, Vec3& axis, Vec3& origin, double& degrees) {
  const ObjectReader object(key, keys_of("mesh.rotate"));
  axis = object.get<Vec3>("axis");
  degrees = object.get<double>("degrees");
  object.read("origin", origin);
}

Json rotation_json(const Vec3& axis, const Vec3& origin, double degrees) {
  return {{"axis", vector_json(axis)}, {"origin", vector_json(origin)}, {"degrees", degrees}};
}

}  // namespace heml
