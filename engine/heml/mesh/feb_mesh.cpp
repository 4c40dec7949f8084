#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/feb_mesh.hpp>
#include <heml/mesh/xml_values.hpp>

namespace heml {
namespace {

std::optional<CellShape> feb_shape(std::string_view type) {
  if (type == "tet4" || type == "tet10") return CellShape::tetrahedron;
  if (type == "pyra5") return CellShape::pyramid;
  if (type == "penta6") return CellShape::wedge;
  if (type == "hex8") return CellShape::brick;
  return std::nullopt;
}

/// Shells, trusses and springs have no volume.
bool is_other_solid(std::string_view type) {
  constexpr std::string_view solids[] = {"hex", "penta", "pyra", "tet"};
  return std::any_of(std::begin(solids), std::end(solids), [&](std::string_view s) { return type.starts_with(s); });
}

void sort_once(std::vector<int>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

class FebMeshReader {
 public:
  explicit FebMeshReader(const XmlElement& root) : root_(root), in_(root.file(), root.document()) {}

  FebMesh read() {
    const auto geometry = root_.child("Geometry"), mesh = root_.child("Mesh");
    if (!geometry && !mesh) root_.fail("the file has no <Mesh> (before 3.0: <Geometry>)");
    const XmlElement body = mesh ? *mesh : *geometry;
    if (body.attribute("from")) body.fail("another file is included", "put its lines here in place of this");
    read_nodes(body);
    for (const XmlElement child : body.children()) read_child(child);
    if (const auto domains = root_.child("MeshDomains"))
      for (const XmlElement domain : domains->children()) set_material(domain);
    return std::move(mesh_);
  }

 private:
  void read_nodes(const XmlElement& body) {
    for (const XmlElement block : body.children()) {
      if (block.name() != "Nodes") continue;
      const std::size_t first = mesh_.read.mesh.nodes.size();
      for (const XmlElement node : block.children()) {
        numbers_.add(id_of(node));
        const std::vector<double> x = numbers_in(node, "the place of a node", 3);
        mesh_.read.mesh.nodes.emplace_back(x[0], x[1], x[2]);
      }
      if (const std::string name = block.attribute_or_empty("name"); !name.empty())
        for (std::size_t n = first; n < mesh_.read.mesh.nodes.size(); ++n)
          mesh_.node_sets[name].push_back(static_cast<int>(n));
    }
    numbers_.finish(in_);
  }

  void read_child(const XmlElement& child) {
    const std::string_view kind = child.name();
    if (kind == "Elements") {
      read_part(child);
    } else if (kind == "NodeSet") {
      read_node_set(child);
    } else if (kind == "Surface") {
      read_surface(child);
    } else if (kind == "Part" || kind == "Instance") {
      child.fail(fmt::format("a <{}>, of an assembly, is not read", kind), "save the model flat");
    } else if (kind != "Nodes" && kind != "SurfacePair") {
      mesh_.unread.push_back(child);
    }
  }

  void read_part(const XmlElement& block) {
    FebPart part{block, plain_name(block.attribute_or_empty("name")), plain_name(block.attribute_or_empty("type")),
                 block.attribute_or_empty("mat")};
    if (part.name.empty()) part.name = fmt::format("part {}", mesh_.parts.size() + 1);
    const int region = static_cast<int>(mesh_.parts.size()) + 1;
    const auto shape = feb_shape(part.element);
    const bool quadratic = part.element == "tet10";
    part.divided = shape && shape != CellShape::tetrahedron;
    for (const XmlElement element : block.children()) {
      if (!shape) {
        mesh_.read.ignored += is_other_solid(part.element);
        continue;
      }
      const std::vector<int> ids = integers_in(element, "the nodes of an element", quadratic ? 10 : corners_of(*shape));
      std::array<int, 10> nodes{};
      for (std::size_t a = 0; a < ids.size(); ++a) nodes[a] = node_of(element, ids[a]);
      if (part.divided)
        divide_cell(*shape, std::span(nodes).first(ids.size()), mesh_.read);
      else
        mesh_.read.mesh.tets.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
      mesh_.read.mesh.regions.resize(mesh_.read.mesh.tets.size(), region);
      if (quadratic)  // the middles of 12, 23, 31, 14, 24, 34, as in VTK
        add_midedges({nodes[4], nodes[5], nodes[6], nodes[7], nodes[8], nodes[9]}, vtk_midedges, mesh_.read);
    }
    if (shape) mesh_.read.mesh.region_names[region] = part.name;
    mesh_.parts.push_back(std::move(part));
  }

  void read_node_set(const XmlElement& set) {
    std::vector<int>& nodes = mesh_.node_sets[name_of(set)];
    for (const XmlElement node : set.children()) {
      if (node.name() != "node" && node.name() != "n")
        node.fail(fmt::format("<{}> in a NodeSet is not read", plain_name(node.name())), "list its nodes");
      nodes.push_back(node_of(node, id_of(node)));
    }
    for (const std::string_view word : words_in(set.text()))
      nodes.push_back(node_of(set, integer_in(set, word, "a node number")));
    sort_once(nodes);
  }

  void read_surface(const XmlElement& set) {
    FebSurface& surface = mesh_.surfaces[name_of(set)];
    for (const XmlElement facet : set.children()) {
      const std::size_t count = facet.name() == "tri3" ? 3 : facet.name() == "quad4" ? 4 : 6;
      if (count == 6 && facet.name() != "tri6") {
        surface.has_other_facets = true;
        continue;
      }
      std::vector<int> nodes;
      for (const int id : integers_in(facet, "the nodes of a facet", count)) nodes.push_back(node_of(facet, id));
      surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
      if (count == 4)  // as the side of a brick is divided
        std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
      surface.triangles.push_back({nodes[0], nodes[1], nodes[2]});
      if (count == 4) surface.triangles.push_back({nodes[0], nodes[2], nodes[3]});
    }
    sort_once(surface.nodes);
  }

  void set_material(const XmlElement& domain) {
    const std::string name = plain_name(domain.attribute_or_empty("name"));
    const auto part =
        std::find_if(mesh_.parts.begin(), mesh_.parts.end(), [&](const FebPart& p) { return p.name == name; });
    if (part == mesh_.parts.end()) domain.fail(fmt::format("names the part '{}', which the mesh does not have", name));
    part->material = domain.attribute_or_empty("mat");
    part->domain = domain;
  }

  std::string name_of(const XmlElement& set) const {
    const std::string name = set.attribute_or_empty("name");
    if (name.empty()) set.fail(fmt::format("a <{}> without a name", set.name()));
    return name;
  }

  int id_of(const XmlElement& node) const {
    const auto id = node.attribute("id");
    if (!id) node.fail("a node without an id");
    return integer_in(node, *id, "the id of a node");
  }

  int node_of(const XmlElement& at, int id) const {
    const int node = numbers_.find_or_none(id);
    if (node < 0) at.fail(fmt::format("names node {}, which the file does not give", id));
    return node;
  }

  XmlElement root_;
  Scanner in_;  ///< for messages of NodeNumbers
  FebMesh mesh_;
  NodeNumbers numbers_;
};

}  // namespace

XmlElement feb_root(const XmlDocument& document) {
  const XmlElement root = document.root();
  if (root.name() != "febio_spec")
    root.fail("is no FEBio file: it begins with <" + plain_name(root.name()) + ">", "<febio_spec version=\"4.0\">");
  const std::string version = root.attribute_or_empty("version");
  if (version != "2.5" && version != "3.0" && version != "4.0")
    root.fail("is of version " + in_quotes(version), "2.5, 3.0 or 4.0: save it in one of these");
  return root;
}

FebMesh read_feb_mesh(const XmlElement& root) { return FebMeshReader(root).read(); }

ReadMesh read_feb(std::string file, std::string_view text) {
  const XmlDocument document(std::move(file), text);
  return read_feb_mesh(feb_root(document)).read;
}

}  // namespace heml
