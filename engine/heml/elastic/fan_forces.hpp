#pragma once
// The forces of elements that have a uniform law: blocks of fans (elastic/fan_block.hpp), each run by the kernel of its
// law.
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

/// Elements (inner numbers, in locality order) of one material without fields, whose rest shapes stay.
struct FanPart {
  const std::vector<int>* elements;
  const Material* material;
  bool isochoric = false;  ///< the law without its volume term, which it must have
};

template <class Real>
class FanForces {
 public:
  FanForces() = default;
  /// mesh: in inner order. No parts: no element has forces.
  FanForces(const TetMesh& mesh, const std::vector<FanPart>& parts, bool continuation, InstructionSet isa,
            ThreadTeam& team);

  /// Other laws for the same elements in the same parts: their layout is kept. Returns whether it could be, which is
  /// where the constants of each part are the same still; else nothing is changed.
  bool update_laws(const std::vector<FanPart>& parts, bool continuation);

  /// Takes an edit of the mesh (FanLayout::after_edit): blocks it did not touch are kept. Returns whether it could,
  /// which is where there are as many parts as before; else nothing is changed.
  bool update_layout(const TetMesh& before, const TetMesh& mesh, const std::vector<FanPart>& parts,
                     const std::vector<int>& origins, ThreadTeam& team);

  bool empty() const { return layout_->blocks.empty(); }

  /// Forces at positions x (3 #V) into f (3 #V, overwritten; zero at nodes of no such element), N. Returns whether
  /// every law is defined there.
  bool forces(const Real* x, Real* f, ThreadTeam& team);

  InstructionSet instruction_set() const { return isa_; }
  double bytes_per_tet() const { return layout_->bytes_per_tet(); }
  /// Of all that is kept.
  std::size_t bytes() const;

 private:
  static constexpr std::size_t grain_ = 4096;  ///< elements below which waking a thread costs more than it brings

  struct Law {
    FanKernel<Real> kernel;
    std::shared_ptr<const void> law;
    FanShape shape;
    Vec3 fibre;               ///< of shape fibre alone
    std::string fibre_field;  ///< likewise
  };
  Law law_of(const FanPart& part, bool continuation) const;

  InstructionSet isa_ = InstructionSet::portable;
  std::shared_ptr<const FanLayout<Real>> layout_ = std::make_shared<const FanLayout<Real>>();  ///< of copies too
  std::vector<Law> laws_;                                                                      ///< of each part
  std::vector<Real> shared_force_;  ///< 3 a shared slot, written and read within forces()
};

}  // namespace heml
