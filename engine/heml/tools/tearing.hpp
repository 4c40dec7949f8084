#pragma once
// Tearing, where a scene asks for it: an element whose largest principal stretch exceeds a limit opens at one of its
// nodes, along the plane across that stretch (mesh/tear.hpp). The most stretched element opens first, so a tear goes on
// at its tip. Tearing depends on the state alone, so a replay repeats it without recorded commands.
//
// Checked before each tick: λ₁ < limit where limit² I − FᵀF has positive leading minors, which needs no eigenvalues.
// The limit depends on the mesh: fracture energy per area is not modelled, and finer elements tear sooner at a notch.
#include <functional>
#include <heml/base/thread_team.hpp>
#include <heml/mesh/tear.hpp>
#include <heml/tools/settings.hpp>

namespace heml {

class Tearing {
 public:
  static constexpr double overload = 1.25;  ///< times the limit: beyond it, more than one element may open in a tick

  /// mesh: at rest. topology: its present elements. All numbers are those of mesh and topology.
  Tearing(const TearingSettings& settings, const TetMesh& mesh, const Topology& topology);

  /// Nodes to open at positions x (#V×3, m), mostly none. One is opened at a time, since it unloads its surroundings;
  /// further ones only for elements beyond `overload` that are not near those already chosen. Nodes with
  /// is_constrained(node) are not opened, since they could not move apart. Linear in the number of elements.
  std::vector<TearOpening> openings(const TetMesh& mesh, const std::vector<Vec3>& x,
                                    const std::function<bool(int)>& is_constrained, ThreadTeam& team);
  const NodeToElements& around() const { return around_; }

 private:
  struct TearCandidate {
    double stretch;
    int element;
    Vec3 plane_normal;  ///< at rest
  };
  Mat3 gradient(const TetMesh& mesh, const std::vector<Vec3>& x, std::size_t element) const;
  std::vector<TearCandidate> overstretched_elements(const TetMesh& mesh, const std::vector<Vec3>& x, ThreadTeam& team);
  std::optional<TearOpening> opening_of(const TearCandidate& torn, const TetMesh& mesh,
                                        const std::function<bool(int)>& is_constrained) const;

  double limit_;
  NodeToElements around_;
  std::vector<int> elements_;
  std::vector<Mat3> inverse_rest_;  ///< Dm⁻¹, 1/m
  std::vector<char> is_overstretched_;
  std::vector<bool> on_surface_;  ///< #V
};

}  // namespace heml
