#include <heml/world/step_cost.hpp>

namespace heml {
namespace {

// ns a tetrahedron, as the ForceCost of a law, of what is beside its kernels, in either precision: `heml bench step
// --quick`, a step with it less that of the law alone. A term in vectorised loops (viscosity, another volume term),
// averaged nodal pressure, relaxation, whose scalar code asks the law twice; a law whose parameters differ between
// elements is asked once by such code. Active stress is estimated: a third of the operations of viscosity.
constexpr double a_loop = 20, active = 6, pressure = 22, relaxation = 200, scalar_law = 100;
constexpr double step_alone = 2;  // its own: positions, velocities, its bound

double cost_of(const KernelInfo& kernel, const WorldSetup& setup) {
  const Material& material = setup.materials[kernel.material].material;
  const ForceCost law = find_law(material.law)->cost;
  double cost = step_alone + (setup.solver.single_precision ? law.in_float : law.in_double);
  if (!material.fields.empty())
    cost += scalar_law;
  else if (material.plasticity)
    cost += a_loop;  // the law itself is in loops
  if (material.volume_term != VolumeTerm::quadratic) cost += a_loop;
  if (!material.relaxation.empty())
    cost += relaxation;
  else if (material.viscosity > 0 || material.bulk_viscosity > 0)
    cost += a_loop;
  if (material.active_stress > 0) cost += active;
  return setup.solver.nodal_pressure ? cost + pressure : cost;
}

}  // namespace

double fixed_step_cost(const std::vector<KernelInfo>& kernels, const WorldSetup& setup) {
  double sum = 0, elements = 0;
  for (const KernelInfo& kernel : kernels) {
    sum += static_cast<double>(kernel.elements) * cost_of(kernel, setup);
    elements += static_cast<double>(kernel.elements);
  }
  // the points of a quadratic element, in loops
  if (setup.solver.quadratic) sum = element_points * (sum + elements * a_loop);
  return 1e-9 * sum / elements;
}

}  // namespace heml
