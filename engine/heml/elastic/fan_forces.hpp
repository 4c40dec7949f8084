#pragma once
// Forces of elements with a uniform law: blocks of fans (elastic/fan_block.hpp), each run by the kernel of its law.
//
//   blocks ──► forces of their own nodes ──► f
//         └──► those of shared nodes ──► summed in the order of blocks ──► f
#include <heml/base/thread_team.hpp>
#include <heml/elastic/fan_kernels.hpp>
#include <heml/elastic/fan_layout.hpp>
#include <heml/materials/material.hpp>
#include <memory>
#include <string>

namespace heml {

/// Elements (inner numbers, in locality order) of one material without fields and with constant rest shapes.
struct FanPart {
  const std::vector<int>* elements;
  const Material* material;
  bool isochoric = false;  ///< without the volume term of the law, which must have one
};

template <class Real>
class FanForces {
 public:
  FanForces() = default;
  /// mesh: in inner order. Without parts all forces are zero.
  FanForces(const TetMesh& mesh, const std::vector<FanPart>& parts, bool continuation, InstructionSet isa,
            ThreadTeam& team);

  /// Replaces the laws of the same elements in the same parts and keeps the layout. Returns false and changes nothing
  /// if the number of parts or the constants of a part (FanShape, fibre) would change.
  bool update_laws(const std::vector<FanPart>& parts, bool continuation);

  /// Updates the layout after an edit of the mesh (FanLayout::after_edit), keeping untouched blocks. Returns false and
  /// changes nothing if the number of parts has changed.
  bool update_layout(const TetMesh& before, const TetMesh& mesh, const std::vector<FanPart>& parts,
                     const std::vector<int>& origins, ThreadTeam& team);

  bool empty() const { return layout_->blocks.empty(); }

  /// Writes the forces (N) at positions x (3 #V, m) into f (3 #V, overwritten; zero at nodes without an element here).
  /// Returns whether every law is defined at x. Uses scratch memory: one call at a time.
  bool forces(const Real* x, Real* f, ThreadTeam& team);

  InstructionSet instruction_set() const { return isa_; }
  double bytes_per_tet() const { return layout_->bytes_per_tet(); }
  /// Size of all arrays, in bytes.
  std::size_t bytes() const;

 private:
  static constexpr std::size_t grain_ = 4096;  ///< min. elements per thread, which outweigh the cost of waking it

  struct Law {
    FanKernel<Real> kernel;
    std::shared_ptr<const void> law;
    FanShape shape;
    Vec3 fibre;               ///< only with FanShape::fibre
    std::string fibre_field;  ///< only with FanShape::fibre
  };
  Law law_of(const FanPart& part, bool continuation) const;

  InstructionSet isa_ = InstructionSet::portable;
  std::shared_ptr<const FanLayout<Real>> layout_ = std::make_shared<const FanLayout<Real>>();  ///< shared by copies
  std::vector<Law> laws_;                                                                      ///< of each part
  std::vector<Real> shared_force_;  ///< 3 a shared slot, scratch of forces()
};

}  // namespace heml
