#include <heml/world/step_cost.hpp>

namespace heml {
namespace {

/// ns a tetrahedron of one evaluation of the forces in double and in float, as `heml bench kernel --quick` found them
/// on one core of an AMD EPYC with AVX2 (irregular cube 9). Without AVX2 twice as much.
struct LawCost {
  std::string_view law;
  double in_double, in_float;
};
constexpr LawCost law_costs[] = {{"stvk", 5.8, 3.3},
                                 {"neo_hookean", 7.9, 4.0},
                                 {"neo_hookean_iso", 12.2, 5.7},
                                 {"mooney_rivlin", 15.9, 7.1},
                                 {"fung_demiray", 17.4, 7.3},
                                 {"ogden", 148, 60},
                                 {"hgo", 20.3, 8.6},
                                 {"yeoh", 23.2, 9.9},
                                 {"gent", 30.7, 13.2},
                                 {"veronda_westmann", 32.0, 13.6},
                                 {"stable_neo_hookean", 6.0, 3.4},
                                 {"paper_neo_hookean", 5.2, 3.0},
                                 {"paper_mooney_rivlin", 6.7, 3.8},
                                 {"paper_fung_demiray", 8.6, 4.3},
                                 {"mass_spring", 17, 14}};
constexpr LawCost of_another_law{"", 20, 9};

// The same of what is beside the kernels, in either precision: `heml bench step --quick`, a step with it less that of
// the law alone. A term in vectorised loops (viscosity, another volume term), averaged nodal pressure, relaxation,
// whose scalar code asks the law twice; a law whose parameters differ between elements is asked once by such code.
constexpr double a_loop = 20, pressure = 22, relaxation = 200, scalar_law = 100;
constexpr double step = 2;  // its own: positions, velocities, its bound

double cost_of(const KernelInfo& kernel, const WorldSetup& setup) {
  const Material& material = setup.materials[kernel.material].material;
  LawCost law = of_another_law;
  for (const LawCost& listed : law_costs)
    if (listed.law == kernel.law) law = listed;
  double cost = step + (setup.solver.single_precision ? law.in_float : law.in_double);
  if (!material.fields.empty())
    cost += scalar_law;
  else if (material.plasticity)
    cost += a_loop;  // the law itself is in loops
  if (material.volume_term != VolumeTerm::quadratic) cost += a_loop;
  if (!material.relaxation.empty())
    cost += relaxation;
  else if (material.viscosity > 0 || material.bulk_viscosity > 0)
    cost += a_loop;
  return setup.solver.nodal_pressure ? cost + pressure : cost;
}

}  // namespace

double fixed_step_cost(const std::vector<KernelInfo>& kernels, const WorldSetup& setup) {
  double sum = 0, elements = 0;
  for (const KernelInfo& kernel : kernels) {
    sum += static_cast<double>(kernel.elements) * cost_of(kernel, setup);
    elements += static_cast<double>(kernel.elements);
  }
  return 1e-9 * sum / elements;
}

}  // namespace heml
