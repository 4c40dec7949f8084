#pragma once
// What a world runs, and the numbers behind its choices, as values: `heml explain` puts them into words
// (scenario/explain.hpp).
#include <heml/elastic/body.hpp>
#include <heml/world/setup.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// How the integrator was chosen; of a given one the numbers are told all the same, where they cost nothing.
struct MethodFacts {
  Integrator asked = Integrator::verlet, used = Integrator::verlet;
  double step_cost = 0;       ///< s an element and explicit step, one core: what the model of cost assumes
  double explicit_share = 0;  ///< computing time over simulated time of explicit steps at the stable length, by it
  double enough = 0;          ///< share up to which "auto" is explicit; where a step is given, up to the stable one
  std::optional<double> lowest_frequency;  ///< 1/s, at rest, 0 of a body that is free; none: nobody needed it
  double resolved = 0;                     ///< tick × frequency below which "auto" takes the accurate method
};

/// What limits explicit steps.
struct StepFacts {
  double tick = 0, stable = 0;  ///< s
  int steps_per_tick = 1;       ///< of the method in use
  int element = -1;             ///< adds most to ω² at the node that limits the step, mesh-file order; −1: springs
  double element_share = 0;     ///< how much of the bound of ω² it adds, to 1
  double added_mass = 0;        ///< by mass scaling (elastic/mass_scaling.hpp), over the body's mass
  int heavier_nodes = 0;        ///< that it was added at
  double scaled_step = 1;       ///< by how much `offered` mass scaling would lengthen the stable step; 1: it is in use
  static constexpr double offered = 0.01;
  double median_ratio = 0;      ///< the bound of that node (elastic/step_weights.hpp) over the one of the median node
};

/// Of an implicit or a static world.
struct SolverFacts {
  Minimiser minimiser = Minimiser::newton;
  Preconditioner preconditioner = Preconditioner::scalar;
  bool by_size = true;  ///< the preconditioner was chosen by the model, not by the scene
  Projection projection = Projection::element;
  std::size_t free_nodes = 0, levels = 0;
  double tolerance = 0;
  bool rescues = false;  ///< a step that does not converge is rescued (step_rescue.hpp); else it ends the run
  std::optional<Budget> budget;
};

struct MemoryFacts {
  const char* what;
  std::size_t bytes;
};

struct WorldFacts {
  std::size_t nodes = 0, tets = 0;               ///< of the mesh file
  std::size_t live_tets = 0;                     ///< of them that are there
  std::size_t constrained_nodes = 0, faces = 0;  ///< faces: of the surface as first made
  int threads = 1;
  std::vector<KernelInfo> kernels;  ///< in the order of the materials that have elements
  MethodFacts method;
  StepFacts step;
  std::optional<SolverFacts> solver;
  std::vector<MemoryFacts> memory;
};

}  // namespace heml
