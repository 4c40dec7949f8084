#pragma once
// Forces of elements of constant rest shapes: blocks of fans (elastic/fan_block.hpp), each run by the kernel of its
// law, or by the one of its law and further terms or parameters that differ (elastic/fan_terms.hpp). Blocks write the
// forces of their own nodes, and those of shared nodes are summed (elastic/node_blocks.hpp).
#include <cassert>
#include <heml/base/thread_team.hpp>
#include <heml/elastic/fan_flow.hpp>
#include <heml/elastic/fan_kernels.hpp>
#include <heml/elastic/fan_layout.hpp>
#include <heml/elastic/fan_state.hpp>
#include <heml/elastic/fan_term_kernels.hpp>
#include <heml/materials/material.hpp>
#include <memory>
#include <string>

namespace heml {

/// Elements (inner numbers, in locality order) of one material with constant rest shapes. The mesh has its fields.
struct FanPart {
  const std::vector<int>* elements;
  const Material* material;
  bool isochoric = false;       ///< without the volume term of the law, which must have one
  bool has_terms = false;       ///< with the material's viscosity, relaxation, plastic flow and volume term
  bool nodal_pressure = false;  ///< forces() takes pressures in place of the volume term
};

template <class Real>
class FanForces {
 public:
  FanForces() = default;
  /// mesh: in inner order. Without parts all forces are zero.
  FanForces(const TetMesh& mesh, const std::vector<FanPart>& parts, bool continuation, InstructionSet isa,
            ThreadTeam& team);

  /// Replaces the laws of the same elements in the same parts and keeps the layout. Returns false and changes nothing
  /// if the number of parts or the constants of a part (FanShape, fibre, fields) would change. Forgets the state.
  bool update_laws(const std::vector<FanPart>& parts, bool continuation);

  /// Updates the layout after an edit of the mesh (FanLayout::after_edit), keeping untouched blocks. Returns false and
  /// changes nothing if the number of parts has changed. Forgets the state.
  bool update_layout(const TetMesh& before, const TetMesh& mesh, const std::vector<FanPart>& parts,
                     const std::vector<int>& origins, ThreadTeam& team);

  bool empty() const { return layout_->blocks.empty(); }

  /// Writes the forces (N) at positions x (3 #V, m) into f (3 #V, overwritten; zero at nodes without an element here).
  /// Returns whether every law is defined at x. Uses scratch memory: one call at a time. pressure: of every node, Pa,
  /// for parts that take it.
  bool forces(const Real* x, Real* f, ThreadTeam& team, const Real* pressure = nullptr);
  /// Writes the sums of V J of the tetrahedra here at each node, m³ (#V, overwritten).
  void node_volumes(const Real* x, Real* sum, ThreadTeam& team);

  // Internal state of parts with terms; as those of ElasticBody.
  bool has_state() const;
  /// Whether read_state(), which reads what is not known, must come before forces() or commit().
  bool needs_state() const { return (has_state() && !state_.is_known()) || (has_flow() && !flow_.is_known()); }
  void forget_state() { state_.forget(), flow_.forget(), evaluated_ = false; }
  void read_state(const std::vector<FanSlots<Real>>& slots);
  void write_state(const std::vector<FanSlots<Real>>& slots) const;
  /// Upper bound of ω² from stress that the state holds, 1/s².
  Real state_bound(const std::vector<FanSlots<Real>>& slots) const;
  void begin_step(Real h);
  /// Costs nothing where forces() were evaluated at this x last.
  void commit(const Real* x);

  /// Pa, of a part with terms whose material gives a fibre (asserted unless 0).
  void set_active_stress(std::size_t part, Real stress) {
    assert(stress == 0 || laws_[part].terms.fibre_constant > 0);
    laws_[part].terms.active = stress;
  }

  // Plastic flow of parts with terms.
  /// Whether forces() were evaluated at this x last, with the rest shapes of now, so that beyond_yield() holds.
  bool is_evaluated_at(const Real* x) const;
  /// The slots of a part that may flow, ascending: all others do not.
  std::vector<std::size_t> beyond_yield(std::size_t part) const { return flow_.beyond(*layout_, part); }
  /// Slots of a part have other rest shapes.
  void put_rest_shapes(std::size_t part, const FanSlots<Real>& of_part, std::span<const std::size_t> slots);
  /// Frees what the next evaluation writes again.
  void drop_scratch();

  InstructionSet instruction_set() const { return isa_; }
  /// Of the elements of one part: layout, and state that is read and written.
  double bytes_per_tet(std::size_t part = 0) const {
    const FanTerms<Real>& terms = laws_[part].terms;
    return layout_->bytes_per_tet() +
           static_cast<double>(sizeof(Real) * (2 * terms.state + (terms.flows ? fan_flow_numbers + 1 : 0)));
  }
  /// Size of all arrays, in bytes.
  std::size_t bytes() const;

 private:
  struct Law {
    FanKernel<Real> kernel;
    std::shared_ptr<const void> law;
    FanShape shape;
    Vec3 fibre;
    std::string fibre_field;
    std::vector<std::string> fields;      ///< of the parameters that differ between elements
    std::vector<std::size_t> parameters;  ///< FanTerms::parameters

    FanTermKernel<Real> term_kernel;
    bool has_terms = false;  ///< else the law alone, with the same parameters in all elements, and active stress
    FanTerms<Real> terms;
    std::vector<RelaxationBranch<Real>> branches;
    std::vector<PronyTerm> relaxation;
    bool takes_pressure = false;
  };
  Law law_of(const FanPart& part, bool continuation) const;
  void add_terms(const FanPart& part, bool continuation, Law& law) const;
  void set_parameters(const FanPart& part, bool isochoric, Law& law) const;
  std::vector<FanTerms<Real>> terms_of_parts(const Real* pressure = nullptr) const;
  FanBlock<Real> block_at(std::size_t b, std::size_t numbers);
  std::size_t blocks_a_thread() const;
  bool has_flow() const;

  InstructionSet isa_ = InstructionSet::portable;
  std::shared_ptr<const FanLayout<Real>> layout_ = std::make_shared<const FanLayout<Real>>();  ///< shared by copies
  std::vector<Law> laws_;                                                                      ///< of each part
  std::vector<Real> shared_force_;  ///< 3 a shared slot, scratch of forces()
  FanState<Real> state_;
  FanFlow<Real> flow_;
  std::size_t nodes_ = 0;          ///< of the mesh
  Real step_ = 0;                  ///< s, of the last begin_step()
  std::vector<Real> evaluated_x_;  ///< where forces() wrote the next state and what is beyond yield
  bool evaluated_ = false;         ///< whether it did, in this step
};

}  // namespace heml
