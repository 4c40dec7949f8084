#pragma once
// Tearing, where a scene asks for it: an element whose largest principal stretch passes a limit lets go at one of its
// nodes, across that stretch (mesh/tear.hpp). Of those beyond the limit one does so that none round it is stretched
// further than, so a tear goes on at its tip. It follows from the state alone, so it is replayed without being
// recorded.
//
// Looked at before each tick: λ₁ < limit where limit² I − FᵀF has positive minors, without a root. A limit is of a
// mesh: what it costs to tear an area is not modelled, and finer elements tear sooner at a notch.
#include <functional>
#include <heml/base/thread_team.hpp>
#include <heml/mesh/tear.hpp>
#include <heml/tools/settings.hpp>

namespace heml {

class Tearing {
 public:
  static constexpr double overload = 1.25;  ///< of the limit

  /// mesh: at rest; its elements that are there. All numbers are those of mesh and topology.
  Tearing(const TearingSettings& settings, const TetMesh& mesh, const Topology& topology);

  /// Nodes that are to open; none in most steps. One, since what it lets go unloads what is round it; others only for
  /// elements that are overdue, and far enough off to share no element with it or its neighbours. x: #V×3, m.
  /// is_constrained(node): such a node is not let go, as it would lie where it lies.
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
  std::vector<TearCandidate> beyond(const TetMesh& mesh, const std::vector<Vec3>& x, ThreadTeam& team);
  std::optional<TearOpening> opening_of(const TearCandidate& torn, const TetMesh& mesh,
                                        const std::function<bool(int)>& is_constrained) const;

  double limit_;
  NodeToElements around_;
  std::vector<int> elements_;
  std::vector<Mat3> inverse_rest_;  ///< Dm⁻¹, 1/m
  std::vector<char> is_beyond_;
  std::vector<bool> on_surface_;  ///< #V
};

}  // namespace heml
