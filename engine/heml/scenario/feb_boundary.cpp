// Conditions of single coordinates become motions of nodes: of all coordinates together where a node has all three.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <heml/mesh/readers.hpp>
#include <heml/mesh/xml_values.hpp>
#include <heml/scenario/feb_material.hpp>
#include <heml/scenario/feb_model.hpp>
#include <map>
#include <set>
#include <tuple>

namespace heml {
namespace {

constexpr std::string_view axis_names[] = {"x", "y", "z"};

/// Where a coordinate of a node goes.
struct FebCourse {
  double at_end = 0;     ///< m
  double ramp_time = 0;  ///< s; of no meaning where at_end is 0
  std::size_t source;    ///< in FebBoundaryReader::sources_
  bool same(const FebCourse& other) const { return at_end == other.at_end && ramp_time == other.ramp_time; }
  double ramp() const { return at_end == 0 ? 0 : ramp_time; }
};

using NodeCourses = std::array<std::optional<FebCourse>, 3>;

class FebBoundaryReader {
 public:
  explicit FebBoundaryReader(FebModel& model) : model_(model) {}

  void read(const XmlElement& section) {
    for (const XmlElement bc : section.children()) {
      const std::string type = bc.attribute_or_empty("type");
      if (bc.name() == "fix")
        fix(bc, axes_in(bc, bc.attribute_or_empty("bc")));
      else if (bc.name() == "prescribe" && (type.empty() || type == "relative"))
        prescribe(bc, bc.attribute_or_empty("bc"), bc.child("value") ? "value" : "scale");
      else if (bc.name() == "bc" && type == "fix")
        fix(bc, axes_in(bc, text_of(bc, "dofs")));
      else if (bc.name() == "bc" && type == "zero displacement")
        fix(bc, axes_that_are_on(bc));
      else if (bc.name() == "bc" && type == "prescribe")
        prescribe(bc, text_of(bc, "dof"), "scale");
      else if (bc.name() == "bc" && type == "prescribed displacement")
        prescribe(bc, text_of(bc, "dof"), "value");
      else if (bc.name() == "bc" && (type == "zero rotation" || type == "zero shell displacement"))
        model_.findings.note(bc, feb_name(bc) + " has no effect without shells");
      else
        model_.findings.refuse(bc, feb_name(bc) + " is not known");
    }
  }

  /// An entry for the nodes of each motion that is prescribed in all directions; then, for each coordinate that some
  /// node leaves others of free, one for all nodes of its course, so that it has the nodes between them too.
  void put(Scene& scene) {
    std::map<std::array<double, 4>, std::vector<int>> groups;
    std::set<std::tuple<std::size_t, double, double>> single;  // axis, at the end, ramp
    for (const auto& [node, courses] : nodes_) {
      if (std::find(courses.begin(), courses.end(), std::nullopt) == courses.end()) {
        if (const auto ramp = common_ramp(courses))
          groups[{courses[0]->at_end, courses[1]->at_end, courses[2]->at_end, *ramp}].push_back(node);
        continue;
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (const auto& course = courses[axis]) single.emplace(axis, course->at_end, course->ramp());
    }
    for (const auto& [motion, nodes] : groups) {
      BoundaryEntry entry;
      entry.where.nodes = nodes;
      entry.motion.translate = Vec3(motion[0], motion[1], motion[2]);
      entry.motion.ramp_time = motion[3];
      scene.boundary.push_back(std::move(entry));
    }
    for (const auto& [axis, at_end, ramp] : single) {
      BoundaryEntry entry;
      entry.motion.axes = AxisSet::none();
      entry.motion.axes.has[axis] = true;
      entry.motion.translate[static_cast<int>(axis)] = at_end;
      entry.motion.ramp_time = ramp;
      for (const auto& [node, courses] : nodes_)
        if (const auto& course = courses[axis]; course && course->at_end == at_end && course->ramp() == ramp)
          entry.where.nodes.push_back(node);
      scene.boundary.push_back(std::move(entry));
    }
    check_midedges(scene);
  }

 private:
  static std::string text_of(const XmlElement& bc, std::string_view child) {
    const auto found = bc.child(child);
    return found ? std::string(found->text()) : "";
  }

  /// Coordinates of a list such as "x,y"; those of shells have no effect.
  std::vector<std::size_t> axes_in(const XmlElement& bc, std::string_view list) {
    std::vector<std::size_t> axes;
    for (const std::string_view word : words_in(list)) {
      const auto axis = std::find(std::begin(axis_names), std::end(axis_names), word);
      if (axis != std::end(axis_names))
        axes.push_back(static_cast<std::size_t>(axis - std::begin(axis_names)));
      else
        model_.findings.note(bc, fmt::format("{}: '{}' has no effect on a solid", feb_name(bc), plain_name(word)));
    }
    return axes;
  }

  static std::vector<std::size_t> axes_that_are_on(const XmlElement& bc) {
    std::vector<std::size_t> axes;
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto on = bc.child(std::string(axis_names[i]) + "_dof"); on && on->text() != "0") axes.push_back(i);
    return axes;
  }

  void fix(const XmlElement& bc, const std::vector<std::size_t>& axes) {
    if (axes.empty()) return;
    sources_.push_back(bc);
    const auto nodes = model_.nodes_of(bc);
    if (!nodes) return;
    for (const int node : *nodes)
      for (const std::size_t axis : axes) assign(node, axis, {0, 0, sources_.size() - 1});
  }

  void prescribe(const XmlElement& bc, const std::string& dof, std::string_view key) {
    const auto axes = axes_in(bc, dof);
    const auto value = bc.child(key);
    if (axes.size() != 1 || !value) {
      model_.findings.refuse(bc, fmt::format("{} has no coordinate x, y or z, or no <{}>", feb_name(bc), key));
      return;
    }
    sources_.push_back(bc);
    const auto number = feb_number(*value, model_.findings);
    const auto nodes =
        model_.nodes_of(bc, bc.attribute("node_set") || !bc.attribute("surface") ? "node_set" : "surface");
    if (!number || !nodes) return;
    const FebFactor factor = model_.factor_of(*value);
    const double at_end = model_.units.length * *number * factor.at_end;
    for (const int node : *nodes)
      assign(node, axes[0], {at_end, factor.ramp_time.value_or(model_.control.end), sources_.size() - 1});
  }

  void assign(int node, std::size_t axis, const FebCourse& course) {
    std::optional<FebCourse>& now = nodes_[node][axis];
    if (now && !now->same(course) && contradicted_.insert({now->source, course.source}).second)
      model_.findings.refuse(
          sources_[course.source],
          fmt::format("{} and {} move {} of node {} (from 0) to different places", feb_name(sources_[now->source]),
                      feb_name(sources_[course.source]), axis_names[axis], node));
    now = course;
  }

  /// Of the coordinates that move; in statics they grow together.
  std::optional<double> common_ramp(const NodeCourses& courses) {
    std::optional<double> ramp;
    for (const auto& course : courses) {
      if (course->at_end == 0) continue;
      if (ramp && *ramp != course->ramp_time && model_.control.dynamic) {
        if (contradicted_.insert({course->source, course->source}).second)
          model_.findings.refuse(sources_[course->source], feb_name(sources_[course->source]) +
                                                               " moves nodes over another time than others move them "
                                                               "in another direction");
        return std::nullopt;
      }
      if (!ramp) ramp = course->ramp_time;
    }
    return ramp.value_or(0);
  }

  /// A scene's list takes the nodes in the middle of edges between its nodes: the file has to want the same.
  void check_midedges(const Scene& scene) {
    if (!scene.solver.quadratic || model_.mesh.read.midedges.empty()) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!has_its_midedges(scene, axis)) return;
  }

  bool has_its_midedges(const Scene& scene, std::size_t axis) {
    const auto& tets = model_.mesh.read.mesh.tets;
    std::vector<std::size_t> entry(model_.mesh.read.mesh.nodes.size(), 0), wanted(entry.size(), 0);
    for (std::size_t b = 0; b < scene.boundary.size(); ++b) {
      if (!scene.boundary[b].motion.axes.has[axis]) continue;
      std::vector<bool> listed(entry.size(), false);
      for (const int n : scene.boundary[b].where.nodes) listed[static_cast<std::size_t>(n)] = true;
      for (std::size_t n = 0; n < listed.size(); ++n)
        if (listed[n]) entry[n] = wanted[n] = b + 1;
      for (std::size_t t = 0; t < tets.size(); ++t)
        for (std::size_t e = 0; e < tet_edges.size(); ++e)
          if (listed[static_cast<std::size_t>(tets[t][tet_edges[e][0]])] &&
              listed[static_cast<std::size_t>(tets[t][tet_edges[e][1]])])
            entry[static_cast<std::size_t>(model_.mesh.read.midedges[t][e])] = b + 1;
    }
    const auto [at, other] = std::mismatch(entry.begin(), entry.end(), wanted.begin());
    if (at == entry.end()) return true;
    model_.findings.refuse(
        sources_.front(), fmt::format("the sets of nodes hold both ends of an edge of a tet10, but not node {} (from "
                                      "0) in its middle, which heml holds and moves with them",
                                      at - entry.begin()));
    return false;
  }

  FebModel& model_;
  std::vector<XmlElement> sources_;
  std::map<int, NodeCourses> nodes_;
  std::set<std::pair<std::size_t, std::size_t>> contradicted_;  ///< sources of which it was said
};

}  // namespace

void read_feb_boundary(FebModel& model, Scene& scene) {
  FebBoundaryReader reader(model);
  for (const XmlElement& section : model.sections("Boundary")) reader.read(section);
  reader.put(scene);
}

}  // namespace heml
