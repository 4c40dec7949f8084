#pragma once
// A FEBio file while it becomes a scene (feb_scene.hpp): its mesh, sections, curves and units, and what was found.
#include <heml/mesh/feb_mesh.hpp>
#include <heml/scenario/feb_curve.hpp>
#include <heml/scenario/feb_findings.hpp>
#include <heml/scenario/scene.hpp>
#include <set>
#include <string_view>
#include <vector>

namespace heml {

/// Time and method of a FEBio file (section Control).
struct FebControl {
  bool dynamic = false;
  double step = 0.1;  ///< s
  double end = 1;     ///< s
};

struct FebModel {
  explicit FebModel(const XmlElement& file) : root(file), mesh(read_feb_mesh(file)) {}

  XmlElement root;
  std::optional<XmlElement> step;  ///< the one <Step>, where there is one
  FebMesh mesh;
  FebUnits units = {};
  FebControl control = {};
  FebCurves curves = {{}, 1};
  FebFindings findings = {};
  /// Ramp times of what the scene has; −1: grows otherwise. For statics, where all grows together.
  std::set<double> courses = {};

  /// All sections of that name, of the file and of its step.
  std::vector<XmlElement> sections(std::string_view name) const;
  /// A factor over time; in dynamics what is no ramp is refused.
  FebFactor factor_of(const XmlElement& value);
  /// Nodes of the set that an attribute names ("@surface:NAME": of a surface). None: it is refused.
  std::optional<std::vector<int>> nodes_of(const XmlElement& element, const char* key = "node_set");
};

/// Dirichlet conditions: section Boundary. feb_boundary.cpp
void read_feb_boundary(FebModel& model, Scene& scene);

/// Nodal, surface and body loads: section Loads. feb_loads.cpp
void read_feb_loads(FebModel& model, Scene& scene);

}  // namespace heml
