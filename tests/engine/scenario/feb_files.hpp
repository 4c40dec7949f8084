#pragma once
// Files of FEBio for tests: the unit cube as five tetrahedra, in each version of the format.
#include <fmt/format.h>

#include <heml/mesh/surface.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <string>

namespace heml::test {

/// Node i + 2 j + 4 k is at (i, j, k) and has the id 10 (number + 1).
inline TetMesh unit_cube() {
  TetMesh mesh;
  for (int n = 0; n < 8; ++n) mesh.nodes.emplace_back(n & 1, n >> 1 & 1, n >> 2 & 1);
  mesh.tets = {{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}};
  for (Tet& t : mesh.tets)
    if (signed_volume(mesh.nodes[static_cast<std::size_t>(t[0])], mesh.nodes[static_cast<std::size_t>(t[1])],
                      mesh.nodes[static_cast<std::size_t>(t[2])], mesh.nodes[static_cast<std::size_t>(t[3])]) < 0)
      std::swap(t[2], t[3]);
  return mesh;
}

/// The parts of a file that tests change. The cube's sets of nodes and surfaces are x0, x1, y0, y1, z0, z1; all: all
/// nodes.
struct FebText {
  std::string version = "4.0";
  std::string module = "<Module type=\"solid\"/>";
  std::string control = "<time_steps>10</time_steps><step_size>0.1</step_size>";
  std::string material =
      "<material id=\"1\" name=\"stuff\" type=\"neo-Hookean\"><density>1100</density>"
      "<E>1000</E><v>0.3</v></material>";
  std::string boundary = {}, loads = {};
  std::string curve = "0,0 1,1";  ///< points of curve 1
  std::string extra = {};         ///< behind all sections
};

/// A set of nodes in the form of the version.
inline std::string feb_node_set(const std::string& version, const std::string& name, const std::vector<int>& nodes) {
  std::string text;
  for (const int n : nodes) {
    const int id = 10 * (n + 1);
    if (version == "4.0")
      text += fmt::format("{}{}", text.empty() ? "" : ", ", id);
    else
      text += fmt::format("<{} id=\"{}\"/>", version == "2.5" ? "node" : "n", id);
  }
  return fmt::format("<NodeSet name=\"{}\">{}</NodeSet>\n", name, text);
}

inline std::string feb_sets(const std::string& version) {
  const TetMesh mesh = unit_cube();
  const BoundaryFaces faces = extract_boundary(mesh);
  std::string text = feb_node_set(version, "all", {0, 1, 2, 3, 4, 5, 6, 7});
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      const std::string name = fmt::format("{}{}", "xyz"[axis], end);
      const auto on_side = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)][axis] == end; };
      std::vector<int> nodes;
      for (int n = 0; n < 8; ++n)
        if (on_side(n)) nodes.push_back(n);
      text += feb_node_set(version, name, nodes) + fmt::format("<Surface name=\"{}\">", name);
      for (const Triangle& f : faces.triangles)
        if (on_side(f[0]) && on_side(f[1]) && on_side(f[2]))
          text += fmt::format("<tri3 id=\"1\">{},{},{}</tri3>", 10 * (f[0] + 1), 10 * (f[1] + 1), 10 * (f[2] + 1));
      text += "</Surface>\n";
    }
  return text;
}

inline std::string feb_curve_text(const std::string& version, const std::string& points) {
  std::string list;
  for (std::size_t at = 0; at < points.size();) {
    const std::size_t end = std::min(points.find(' ', at), points.size());
    list += fmt::format("<{0}>{1}</{0}>", version == "4.0" ? "pt" : "point", points.substr(at, end - at));
    at = end + 1;
  }
  if (version == "2.5") return "<loadcurve id=\"1\" type=\"linear\">" + list + "</loadcurve>";
  return "<load_controller id=\"1\" type=\"loadcurve\"><interpolate>LINEAR</interpolate><points>" + list +
         "</points></load_controller>";
}

/// Elements 1 and 2 are part "core", the others "shell".
inline std::string feb_cube(const FebText& with) {
  const TetMesh mesh = unit_cube();
  const bool old = with.version == "2.5";
  std::string nodes, parts[2];
  for (int n = 0; n < 8; ++n) {
    const Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
    nodes += fmt::format("<node id=\"{}\">{}, {}, {}</node>\n", 10 * (n + 1), x.x(), x.y(), x.z());
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& e = mesh.tets[t];
    parts[t < 2 ? 0 : 1] += fmt::format("<elem id=\"{}\">{},{},{},{}</elem>\n", t + 1, 10 * (e[0] + 1), 10 * (e[1] + 1),
                                        10 * (e[2] + 1), 10 * (e[3] + 1));
  }
  const std::string mesh_text = fmt::format(
      "<Nodes name=\"body\">{}</Nodes>\n<Elements type=\"tet4\" name=\"core\"{}>{}</Elements>\n"
      "<Elements type=\"tet4\" name=\"shell\"{}>{}</Elements>\n{}",
      nodes, old ? " mat=\"1\"" : "", parts[0], old ? " mat=\"1\"" : "", parts[1], feb_sets(with.version));
  const std::string body = old ? "<Geometry>" + mesh_text + "</Geometry>"
                               : "<Mesh>" + mesh_text +
                                     "</Mesh>\n<MeshDomains><SolidDomain name=\"core\" mat=\"stuff\"/>"
                                     "<SolidDomain name=\"shell\" mat=\"stuff\"/></MeshDomains>";
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<febio_spec version=\"{}\">\n{}\n<Control>{}</Control>\n"
      "<Material>{}</Material>\n{}\n<Boundary>{}</Boundary>\n<Loads>{}</Loads>\n"
      "<LoadData>{}</LoadData>\n{}</febio_spec>\n",
      with.version, with.module, with.control, with.material, body, with.boundary, with.loads,
      feb_curve_text(with.version, with.curve), with.extra);
}

/// All coordinates of all nodes, so that the cube is stretched by `stretches` along the axes.
inline std::string feb_stretch(const std::string& version, const Vec3& stretches) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    const double u = stretches[axis] - 1;
    if (version == "2.5")
      text += fmt::format(
          "<fix bc=\"{0}\" node_set=\"{0}0\"/><prescribe bc=\"{0}\" node_set=\"{0}1\"><scale lc=\"1\">{1}"
          "</scale><relative>0</relative></prescribe>\n",
          name, u);
    else if (version == "3.0")
      text += fmt::format(
          "<bc type=\"fix\" node_set=\"{0}0\"><dofs>{0}</dofs></bc><bc type=\"prescribe\" "
          "node_set=\"{0}1\"><dof>{0}</dof><scale lc=\"1\">{1}</scale></bc>\n",
          name, u);
    else
      text += fmt::format(
          "<bc type=\"zero displacement\" node_set=\"{0}0\"><{0}_dof>1</{0}_dof></bc><bc "
          "type=\"prescribed displacement\" node_set=\"{0}1\"><dof>{0}</dof><value lc=\"1\">{1}</value></bc>\n",
          name, u);
  }
  return text;
}

/// Holds all nodes of the side x = 0.
inline const char* const feb_held =
    "<bc name=\"wall\" type=\"zero displacement\" "
    "node_set=\"x0\"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc>";

}  // namespace heml::test
