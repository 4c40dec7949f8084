#pragma once
// What the accuracy study holds still and what it varies.
//
//   Specimen   a scene with its mesh and element: time errors are of its own exact motion
//   Method     how that motion is computed: integrator, step, iterations, precision, threads
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// Makes the worlds of a study; tests of the study give one that makes broken ones.
using MakeWorld = std::function<std::unique_ptr<World>(WorldSetup)>;

struct Problem {
  Scene scene;
  WorldSetup setup;          ///< load_setup(scene), perhaps on another mesh
  std::vector<double> mass;  ///< #V, kg, lumped: the weights of errors
  bool nodal_pressure() const { return setup.solver.nodal_pressure; }
};

struct Method {
  Integrator integrator = Integrator::verlet;
  std::optional<double> step = {};  ///< s; none: explicit at the live limit, in ticks of a millisecond
  int iterations = 0;               ///< of an implicit stage; 0: as many as its tolerance asks for
  bool single_precision = false;
  int threads = 1;  ///< 0: all cores
};

/// Loads a scene; one without a name gets its file's. Throws InputError.
Problem problem_of(const Scene& scene);
/// With the masses of its setup.
Problem with_masses(Problem problem);
/// On the mesh with every tetrahedron in eight; what was selected takes in the middles between what was selected.
Problem finer(const Problem& problem);
/// With the other kind of element.
Problem with_element(Problem problem, bool nodal_pressure);
/// Whether averaged nodal pressure is defined for all its laws, at the start and after every event.
bool takes_nodal_pressure(const Problem& problem);
/// With averaged nodal pressure or without: the specimen's own first, then the other where it is defined.
std::vector<bool> elements_of(const Problem& problem);
/// A name that other scenes do not have: its own and a hash of all there is in it.
std::string key_of(const Problem& problem);
/// Stable name of the mesh and element: "p1, 1600 tetrahedra".
std::string text_of(const Problem& problem);

/// Solved by a method. Events keep their times, as nearly as its ticks allow.
Scene with_method(Scene scene, const Method& method);
/// "tr_bdf2, steps of 10 ms, 1 iteration, float, 1 thread".
std::string text_of(const Method& method);

}  // namespace heml
