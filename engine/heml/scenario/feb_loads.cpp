#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <heml/mesh/readers.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/mesh/xml_values.hpp>
#include <heml/scenario/feb_material.hpp>
#include <heml/scenario/feb_model.hpp>
#include <map>
#include <set>

namespace heml {
namespace {

using FaceKey = std::array<int, 3>;  ///< its nodes, ascending

FaceKey face_key(const Triangle& face) {
  FaceKey key = face;
  std::sort(key.begin(), key.end());
  return key;
}

/// Even permutations of a face's nodes have its outward side.
bool same_side(const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == b[0]) return a[(k + 1) % 3] == b[1];
  return false;
}

bool is_on(const XmlElement& load, std::string_view flag) {
  const auto child = load.child(flag);
  return child && child->text() != "0" && child->text() != "false";
}

/// Faces that a scene can name by their nodes.
struct FacePart {
  std::set<int> nodes;
  std::set<FaceKey> faces;
};

class FebLoadReader {
 public:
  FebLoadReader(FebModel& model, Scene& scene) : model_(model), scene_(scene) {}

  void read(const XmlElement& section) {
    for (const XmlElement load : section.children()) {
      const std::string type = load.attribute_or_empty("type");
      const std::string_view kind = load.name();
      if (kind == "nodal_load" && (type.empty() || type == "nodal_load"))
        nodal_load(load);
      else if (kind == "nodal_load" && type == "nodal_force")
        nodal_force(load);
      else if (kind == "surface_load" && type == "pressure")
        pressure(load);
      else if (kind == "surface_load" && type == "traction")
        traction(load);
      else if (kind == "body_load" && (type == "const" || type == "body force"))
        body_force(load);
      else
        model_.findings.refuse(load, feb_name(load) + " is not known");
    }
  }

 private:
  /// A child that holds numbers, and its factor.
  struct Value {
    std::vector<double> numbers;
    FebFactor factor;
  };

  /// None: it is refused.
  std::optional<Value> value_of(const XmlElement& load, std::string_view key, std::size_t count) {
    const auto child = load.child(key);
    if (!child) {
      model_.findings.refuse(load, fmt::format("{} has no <{}>", feb_name(load), key));
      return std::nullopt;
    }
    if (child->attribute("type").value_or(count == 1 ? "const" : "vector") != (count == 1 ? "const" : "vector") &&
        child->attribute("type") != "const") {
      model_.findings.refuse(*child, fmt::format("<{}> of {} varies from place to place", key, feb_name(load)));
      return std::nullopt;
    }
    return Value{numbers_in(*child, fmt::format("<{}>", key), count), model_.factor_of(*child)};
  }

  void nodal_load(const XmlElement& load) {
    const auto dof = load.child("dof");
    const std::string axis = dof ? std::string(dof->text()) : load.attribute_or_empty("bc");
    if (axis != "x" && axis != "y" && axis != "z") {
      model_.findings.refuse(load, feb_name(load) + " has no coordinate x, y or z");
      return;
    }
    if (is_on(load, "relative")) {
      model_.findings.refuse(load, feb_name(load) + " is relative to the forces at the start");
      return;
    }
    const auto value = value_of(load, "scale", 1);
    Vec3 force = Vec3::Zero();
    if (value) force[axis[0] - 'x'] = value->numbers[0];
    if (value) add_forces(load, force, value->factor);
  }

  void nodal_force(const XmlElement& load) {
    if (const auto value = value_of(load, "value", 3))
      add_forces(load, Vec3(value->numbers[0], value->numbers[1], value->numbers[2]), value->factor);
  }

  /// force: on each node, as FEBio has it; a scene's force is that of all its nodes. Quadratic elements would spread it
  /// over faces, so each node gets an entry.
  void add_forces(const XmlElement& load, const Vec3& force, const FebFactor& factor) {
    const auto nodes = model_.nodes_of(load);
    const Vec3 each = model_.units.force * factor.at_end * force;
    if (!nodes || each.isZero(0)) return;
    LoadEntry entry;
    entry.load.ramp_time = factor.ramp_time.value_or(model_.control.end);
    if (scene_.solver.quadratic) {
      entry.load.vector = each;
      for (const int node : *nodes) {
        entry.where.nodes = {node};
        scene_.loads.push_back(entry);
      }
      return;
    }
    entry.where.nodes = *nodes;
    entry.load.vector = static_cast<double>(nodes->size()) * each;
    scene_.loads.push_back(std::move(entry));
  }

  void pressure(const XmlElement& load) {
    if (is_on(load, "linear") || is_on(load, "shell_bottom")) {
      model_.findings.refuse(load, feb_name(load) +
                                       " acts along the surface at rest (linear) or on a shell's bottom; "
                                       "heml's follows the deformed surface");
      return;
    }
    const auto value = value_of(load, "pressure", 1);
    if (!value) return;
    LoadEntry entry;
    entry.load.kind = Load::Kind::pressure;
    entry.load.pressure = model_.units.stress() * value->factor.at_end * value->numbers[0];
    entry.load.ramp_time = value->factor.ramp_time.value_or(model_.control.end);
    add_on_surface(load, entry);
  }

  void traction(const XmlElement& load) {
    if (is_on(load, "shell_bottom")) {
      model_.findings.refuse(load, feb_name(load) + " acts on a shell's bottom");
      return;
    }
    const auto value = value_of(load, "traction", 3);
    std::optional<Value> scale = Value{{1}, {}};
    if (load.child("scale")) scale = value_of(load, "scale", 1);
    if (!value || !scale) return;
    if (!is_on(load, "linear"))
      model_.findings.note(load, feb_name(load) +
                                     " is taken by the area of the surface at rest, as FEBio does with <linear>1; "
                                     "without it FEBio's newer versions take the deformed area");
    const bool vector_moves = load.child("traction")->attribute("lc").has_value();
    if (vector_moves && load.child("scale") && load.child("scale")->attribute("lc")) {
      model_.findings.refuse(load, feb_name(load) + " grows by two load curves at once");
      return;
    }
    const FebFactor& factor = vector_moves ? value->factor : scale->factor;
    LoadEntry entry;
    entry.load.kind = Load::Kind::traction;
    entry.load.vector = model_.units.stress() * factor.at_end * scale->numbers[0] *
                        Vec3(value->numbers[0], value->numbers[1], value->numbers[2]);
    entry.load.ramp_time = factor.ramp_time.value_or(model_.control.end);
    add_on_surface(load, entry);
  }

  /// A scene names faces by their nodes, which may hold other faces too: then the surface is parted so that no part's
  /// do. Facets wound inward have the pressure turned.
  void add_on_surface(const XmlElement& load, const LoadEntry& entry) {
    const auto surface = model_.mesh.surfaces.find(load.attribute_or_empty("surface"));
    if (surface == model_.mesh.surfaces.end()) {
      model_.findings.refuse(load, fmt::format("{} names the surface '{}', which the mesh does not have",
                                               feb_name(load), plain_name(load.attribute_or_empty("surface"))));
      return;
    }
    if (faces_.empty()) find_faces();
    std::vector<Triangle> sides[2];  // wound outward, inward
    std::set<FaceKey> seen;
    for (const Triangle& facet : surface->second.triangles) {
      const auto face = faces_.find(face_key(facet));
      if (face == faces_.end() || !seen.insert(face->first).second) {
        model_.findings.refuse(
            load,
            fmt::format("a facet of surface '{}' is {} (its nodes, from 0: {}, {}, {})", plain_name(surface->first),
                        face == faces_.end() ? "no face of the body's boundary" : "there twice", facet[0], facet[1],
                        facet[2]));
        return;
      }
      sides[same_side(facet, face->second) ? 0 : 1].push_back(face->second);
    }
    if (surface->second.has_other_facets || surface->second.triangles.empty()) {
      model_.findings.refuse(
          load, fmt::format("surface '{}' has no facets, or some that are no triangles", plain_name(surface->first)));
      return;
    }
    if (entry.load.pressure == 0 && entry.load.vector.isZero(0)) return;
    const bool sided = entry.load.kind == Load::Kind::pressure;
    if (!sided) sides[0].insert(sides[0].end(), sides[1].begin(), sides[1].end());
    add_parts(sides[0], entry);
    LoadEntry turned = entry;
    turned.load.pressure = -entry.load.pressure;
    if (sided) add_parts(sides[1], turned);
  }

  void find_faces() {
    TetMesh mesh = model_.mesh.read.mesh;
    for (Tet& t : mesh.tets) {  // as check_tets() turns them over
      const auto X = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(t[i])]; };
      if (signed_volume(X(0), X(1), X(2), X(3)) < 0) std::swap(t[2], t[3]);
    }
    for (const Triangle& face : extract_boundary(mesh).triangles) {
      faces_.emplace(face_key(face), face);
      for (const int n : face) faces_at_[n].push_back(face_key(face));
    }
  }

  void add_parts(const std::vector<Triangle>& facets, LoadEntry entry) {
    if (facets.empty()) return;
    FacePart whole;
    for (const Triangle& facet : facets) {
      whole.nodes.insert(facet.begin(), facet.end());
      whole.faces.insert(face_key(facet));
    }
    std::vector<FacePart> parts;
    if (std::all_of(whole.nodes.begin(), whole.nodes.end(), [&](int n) { return holds_only_its_own(whole, n); }))
      parts.push_back(std::move(whole));
    else
      for (const Triangle& facet : facets) add_facet(facet, parts);
    for (const FacePart& part : parts) {
      entry.where.nodes.assign(part.nodes.begin(), part.nodes.end());
      scene_.loads.push_back(entry);
    }
  }

  /// To the first part that can take it.
  void add_facet(const Triangle& facet, std::vector<FacePart>& parts) const {
    for (FacePart& part : parts) {
      std::vector<int> added;
      for (const int n : facet)
        if (part.nodes.insert(n).second) added.push_back(n);
      part.faces.insert(face_key(facet));
      if (std::all_of(facet.begin(), facet.end(), [&](int n) { return holds_only_its_own(part, n); })) return;
      for (const int n : added) part.nodes.erase(n);
      part.faces.erase(face_key(facet));
    }
    parts.push_back({{facet.begin(), facet.end()}, {face_key(facet)}});
  }

  /// Whether of the faces at a node those with all nodes in the part are the part's.
  bool holds_only_its_own(const FacePart& part, int node) const {
    const std::vector<FaceKey>& near = faces_at_.at(node);
    return std::all_of(near.begin(), near.end(), [&](const FaceKey& face) {
      return part.faces.contains(face) ||
             !std::all_of(face.begin(), face.end(), [&](int n) { return part.nodes.contains(n); });
    });
  }

  /// FEBio's residual has −ρ f: a force of (0, 0, 9.81) pulls down.
  void body_force(const XmlElement& load) {
    if (load.attribute("elem_set") || load.attribute("domain")) {
      model_.findings.refuse(load, feb_name(load) + " acts on a part of the body alone");
      return;
    }
    if (load.child("force")) {
      if (const auto value = value_of(load, "force", 3))
        add_gravity(load, Vec3(value->numbers[0], value->numbers[1], value->numbers[2]), value->factor);
      return;
    }
    for (int i = 0; i < 3; ++i) {
      const std::string axis(1, static_cast<char>('x' + i));
      if (!load.child(axis)) continue;
      if (const auto value = value_of(load, axis, 1))
        add_gravity(load, value->numbers[0] * Vec3::Unit(i), value->factor);
    }
  }

  void add_gravity(const XmlElement& load, const Vec3& force, const FebFactor& factor) {
    if (model_.control.dynamic && factor.ramp_time != 0.0 && !force.isZero(0))
      model_.findings.refuse(load, feb_name(load) + " grows over time; heml's gravity is constant in dynamics");
    scene_.gravity -= model_.units.length * factor.at_end * force;
  }

  FebModel& model_;
  Scene& scene_;
  std::map<FaceKey, Triangle> faces_;  ///< of the body's boundary, outward
  std::map<int, std::vector<FaceKey>> faces_at_;
};

}  // namespace

void read_feb_loads(FebModel& model, Scene& scene) {
  FebLoadReader reader(model, scene);
  for (const XmlElement& section : model.sections("Loads")) reader.read(section);
}

}  // namespace heml
