#pragma once
// What the accuracy study fixes and what it varies.
//
//   Problem   a scene with its mesh and element; time errors are relative to its own exact motion
//   Method    how that motion is computed: integrator, step, iterations, precision, threads
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// Creates the worlds of a study; tests of the study pass one that creates faulty worlds.
using MakeWorld = std::function<std::unique_ptr<World>(WorldSetup)>;

struct Problem {
  Scene scene;
  WorldSetup setup;          ///< load_setup(scene), perhaps on another mesh
  std::vector<double> mass;  ///< #V, kg, lumped: the weights of errors
  std::string element() const { return std::string(setup.solver.element()); }
};

struct Method {
  Integrator integrator = Integrator::verlet;
  std::optional<double> step = {};  ///< s; none: stable steps of explicit methods, in ticks of 1 ms
  int iterations = 0;               ///< at most, per implicit stage; 0: until its tolerance is met
  bool single_precision = false;
  int threads = 1;  ///< 0: all cores
};

/// Loads a scene; one without a name is named after its file. Throws InputError.
Problem problem_of(const Scene& scene);
/// With the lumped masses of its setup.
Problem with_masses(Problem problem);
/// On the uniformly subdivided mesh (every tetrahedron in eight), of linear elements (asserted). Selections gain the
/// midpoints of their edges.
Problem finer(const Problem& problem);
/// Of linear elements: that of the problem or, of quadratic ones, on their corners alone; none where nodes of the mesh
/// file are in the middle of edges.
std::optional<Problem> linear_base(const Problem& problem);
/// With another element, by name. From quadratic to linear elements only linear_base() leads. Quadratic elements take
/// no recovery, which is switched off.
Problem with_element(Problem problem, const std::string& element);
bool is_quadratic(const std::string& element);
/// Whether averaged pressure is defined for all its laws, at the start and after every event.
bool supports_nodal_pressure(const Problem& problem);
/// That of the problem first, then others that its laws and events allow: of linear elements p1, nodal_pressure, and
/// p2, or p2_pressure where Poisson's ratio is high.
std::vector<std::string> elements_of(const Problem& problem);
/// A unique name: that of the scene, and a hash of scene, mesh and initial positions.
std::string key_of(const Problem& problem);
/// Stable name of the element and mesh: "p1, 1600 tetrahedra".
std::string text_of(const Problem& problem);

/// The scene solved by a method. Events keep their times, rounded to its ticks.
Scene with_method(Scene scene, const Method& method);
/// "tr_bdf2, steps of 10 ms, 1 iteration, float, all cores".
std::string text_of(const Method& method);

}  // namespace heml
