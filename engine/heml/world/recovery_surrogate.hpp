#pragma once
// The body that a recovery steps in place of the scene's: the same mesh, loads and grasps, with every material replaced
// by a stable Neo-Hookean of the same shear modulus at rest (materials/stable_neo_hookean.hpp), defined in every state.
#include <heml/world/implicit_state.hpp>

namespace heml {

template <class Real>
struct RecoverySurrogate {
  ElasticBody<Real> body;
  ImplicitState<Real> implicit;

  /// setup: the scene's, a material per index in model.material_of. masses: as the world's. All must outlive this.
  RecoverySurrogate(const Shared<Model<Real>>& model, const WorldSetup& setup, const Shared<NodeMasses<Real>>& masses,
                    const std::vector<GraspSpring<Real>>& grasps,
                    Contacts& contacts, ThreadTeam& team);
};

}  // namespace heml
