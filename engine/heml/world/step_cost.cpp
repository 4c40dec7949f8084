#include <heml/world/step_cost.hpp>

namespace heml {
namespace {

// ns a tetrahedron, as the ForceCost of a law, of what is beside its kernel, in either precision: `heml bench terms
// --quick`, a step with it less that of the law alone. A vectorised loop over slots, in which laws run that kernels do
// not, takes several times as long as a pass within a kernel.
constexpr double a_loop = 20, a_pass = 4, active = 1, pressure_in_loops = 22, pressure_in_fans = 6;
// ns a point of quadratic elements, which shares no edges with others: `heml solve` of a block with and without.
constexpr double a_point = 12;
constexpr double step_alone = 2;  // its own: positions, velocities, its bound

double cost_of(const KernelInfo& kernel, const WorldSetup& setup) {
  const Material& material = setup.materials[kernel.material].material;
  const ForceCost law = find_law(material.law)->cost;
  const bool in_loops = kernel.kernel == "corners";
  const double a_term = in_loops ? a_loop : a_pass;
  double cost = step_alone + (setup.solver.single_precision ? law.in_float : law.in_double);
  if (in_loops) cost += a_loop;
  if (kernel.kernel.starts_with("points")) cost += a_point;
  if (material.volume_term != VolumeTerm::quadratic) cost += a_term;
  if (!material.relaxation.empty())  // in loops the law is asked twice more
    cost += a_term * (in_loops ? 3 : 1 + static_cast<double>(material.relaxation.size()));
  else if (material.viscosity > 0 || material.bulk_viscosity > 0)
    cost += a_term;
  if (material.plasticity) cost += a_term;
  if (material.active_stress > 0) cost += in_loops ? a_loop : active;
  return setup.solver.nodal_pressure ? cost + (in_loops ? pressure_in_loops : pressure_in_fans) : cost;
}

}  // namespace

double fixed_step_cost(const std::vector<KernelInfo>& kernels, const WorldSetup& setup) {
  double sum = 0, elements = 0;
  for (const KernelInfo& kernel : kernels) {
    sum += static_cast<double>(kernel.elements) * cost_of(kernel, setup);
    elements += static_cast<double>(kernel.elements);
  }
  if (setup.solver.quadratic) sum *= element_points;
  return 1e-9 * sum / elements;
}

}  // namespace heml
