#pragma once
// The elastic part of a body: its groups of elements, each with its law, and the sum of their forces at the nodes.
#include <heml/base/thread_team.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/group_law.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <memory>
#include <vector>

namespace heml {

template <class Real>
class ElasticBody {
 public:
  /// mesh: in inner order. material_of: #T, index into materials. Materials no element has get no group.
  ElasticBody(const TetMesh& mesh, const std::vector<int>& material_of, const std::vector<Material>& materials,
              bool continuation);

  /// Forces at positions x (3 #V) into f (3 #V, overwritten), N. Returns whether every law is defined there.
  bool forces(const Real* x, Real* f, ThreadTeam& team);

  /// J.
  double energy(const Real* x) const;

  /// Upper bound of ω², 1/s², of small vibrations about x; not a number where a law is not defined.
  Real frequency_bound(const Real* x, ThreadTeam& team);

  /// First element (inner number) out of its law's range; −1: none.
  int first_invalid(const Real* x) const;

  /// #T in inner order.
  void states(const Real* x, std::vector<ElementState<Real>>& out) const;

  /// Puts another law on the elements of one material.
  void set_material(std::size_t index, const Material& material);

  /// Lumped masses (#V, kg): each tetrahedron's density × volume / 4 on its nodes.
  std::vector<Real> masses() const;

  std::size_t nodes() const { return corners_.start.size() - 1; }

 private:
  struct Part {
    std::size_t material;
    ElementGroup<Real> group;
    std::unique_ptr<GroupLaw<Real>> law;
  };
  static constexpr std::size_t grain_ = 2048;  ///< elements below which waking a thread costs more than it brings

  std::vector<Part> parts_;
  CornerMap corners_;
  std::vector<Real> corner_;  ///< 3 a corner, written and read within forces()
  bool continuation_;
};

}  // namespace heml
