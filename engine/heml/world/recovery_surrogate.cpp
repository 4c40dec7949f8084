#include <algorithm>
#include <heml/world/recovery_surrogate.hpp>

namespace heml {
namespace {

/// As stiff in shear at rest: of elements whose parameters come from a field, the mean; of a net of springs, the
/// largest modulus of its elements. Poisson's ratio is 1/4 at most: with a stiff volume a tangle turns its elements
/// upright before it has come undone, and stays one (0.45 and more: a third of collapses; 1/4: none of 220).
Material surrogate_material(const Material& material, double max_modulus) {
  const auto [shear, bulk] = small_strain_moduli(material);
  const double mu = shear > 0 ? shear : max_modulus;
  const double lambda = shear > 0 ? std::clamp(bulk - 2 * shear / 3, 0.0, mu) : mu;
  Material stable;
  stable.law = "stable_neo_hookean";
  stable.parameters = {lambda, mu};
  stable.density = material.density;
  return stable;
}

std::vector<Material> surrogate_materials(const TetMesh& mesh, const std::vector<int>& material_of,
                                          const std::vector<RegionMaterial>& materials) {
  const std::vector<double> moduli = preconditioner_moduli(mesh, material_of, materials, Minimiser::newton);
  std::vector<double> largest(materials.size(), 0.0);
  for (std::size_t t = 0; t < moduli.size(); ++t) {
    double& of_material = largest[static_cast<std::size_t>(material_of[t])];
    of_material = std::max(of_material, moduli[t]);
  }
  std::vector<Material> result;
  for (std::size_t m = 0; m < materials.size(); ++m)
    result.push_back(surrogate_material(materials[m].material, largest[m]));
  return result;
}

}  // namespace

template <class Real>
RecoverySurrogate<Real>::RecoverySurrogate(const Shared<Model<Real>>& model, const WorldSetup& setup,
                                           const Shared<NodeMasses<Real>>& masses,
                                           const std::vector<GraspSpring<Real>>& grasps, Contacts& contacts,
                                           ThreadTeam& team)
    : body(model->mesh, model->material_of, surrogate_materials(model->mesh, model->material_of, setup.materials),
           {false, false, setup.instruction_set, 0, setup.solver.threads}, model->midedges),
      implicit(body, model, masses,
               preconditioner_moduli(model->mesh, model->material_of, setup.materials, Minimiser::newton), grasps,
               contacts, team, {}, setup.instruction_set) {
  implicit.body.disable_self_contact();  // a tangle is not to hold itself
}

template struct RecoverySurrogate<float>;
template struct RecoverySurrogate<double>;

}  // namespace heml
