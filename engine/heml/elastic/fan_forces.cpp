#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <heml/elastic/fan_energy.hpp>
#include <heml/elastic/fan_forces.hpp>
#include <heml/elastic/viscoelastic_term.hpp>
#include <heml/materials/laws.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/math/bytes.hpp>

namespace heml {
namespace {

constexpr std::size_t element_grain = 1024;  // min. elements per thread, which outweigh the cost of a fork

FanElements elements_of(const TetMesh& mesh, const FanPart& part, FanShape shape) {
  FanElements result{*part.elements, shape};
  for (const FieldParameter& parameter : part.material->fields)
    result.parameters.push_back(&find_field(mesh, parameter.field)->values);
  if (shape != FanShape::fibre && !part.material->gives_fibre()) return result;
  result.has_fibre_beside = shape != FanShape::fibre;
  const std::string& field = part.material->fibre_field;
  const std::vector<double>* values = field.empty() ? nullptr : &find_field(mesh, field)->values;
  result.fibre = [values, fibre = part.material->fibre](int t) -> Vec3 {
    return values ? Eigen::Map<const Vec3>(&(*values)[3 * static_cast<std::size_t>(t)]).normalized() : fibre;
  };
  return result;
}

}  // namespace

template <class Real>
FanForces<Real>::FanForces(const TetMesh& mesh, const std::vector<FanPart>& parts, bool continuation,
                           InstructionSet isa, ThreadTeam& team)
    : isa_(resolve(isa)), nodes_(mesh.nodes.size()) {
  std::vector<FanElements> elements;
  for (const FanPart& part : parts) {
    laws_.push_back(law_of(part, continuation));
    elements.push_back(elements_of(mesh, part, laws_.back().shape));
  }
  layout_ = std::make_shared<const FanLayout<Real>>(mesh, elements, lanes_of<Real>(isa_), team);
  begin_step(0);
}

template <class Real>
typename FanForces<Real>::Law FanForces<Real>::law_of(const FanPart& part, bool continuation) const {
  const Material& material = *part.material;
  const bool isochoric = part.isochoric || (part.has_terms && !material.relaxation.empty());  // what relaxes
  Law result;
  if (find_energy_law(material.law))
    with_invariant_energy<Real>(material, [&]<class L>(const L& law) {
      result.kernel = energy_fan_kernel<Real>(isa_, L::uses_I4);
      result.law = std::make_shared<const L>(law);
      result.shape = L::uses_I4 ? FanShape::fibre : FanShape::plain;
    });
  else
    with_law<Real>(material, continuation, [&]<class L>(L law) {
      if constexpr (L::has_volume_term)
        if (isochoric) law.kappa = 0;
      result.kernel = fan_kernel<Real>(isa_, law_index(L::name), continuation);
      result.law = std::make_shared<const L>(law);
      result.shape = PrincipalLaw<L, Real> ? FanShape::principal : L::uses_I4 ? FanShape::fibre : FanShape::plain;
    });
  const bool has_fibre = result.shape == FanShape::fibre || material.gives_fibre();
  result.fibre = has_fibre && material.fibre_field.empty() ? material.fibre : Vec3::Zero();
  if (has_fibre) result.fibre_field = material.fibre_field;
  set_parameters(part, isochoric, result);
  add_terms(part, continuation, result);
  return result;
}

template <class Real>
void FanForces<Real>::add_terms(const FanPart& part, bool continuation, Law& law) const {
  const Material& material = *part.material;
  const LawInfo& info = *find_law(material.law);
  FanTerms<Real>& terms = law.terms;
  if (part.has_terms) {
    terms.eta = static_cast<Real>(material.viscosity);
    terms.zeta = static_cast<Real>(material.bulk_viscosity);
    if (terms.eta > 0 || terms.zeta > 0) terms.viscous_state = 6;
    law.relaxation = material.relaxation;
    terms.flows = material.plasticity.has_value();
    const bool relaxes = !law.relaxation.empty();
    terms.state = terms.viscous_state + (relaxes ? 6 * (1 + law.relaxation.size()) : 0);
    if (info.has_volume_term && (relaxes || material.volume_term != VolumeTerm::quadratic)) {
      terms.has_volume = true;
      terms.volume = material.volume_term;
      terms.kappa = static_cast<Real>(material.parameters[*volume_parameter(material, info)]);
    }
  }
  law.takes_pressure = part.nodal_pressure;
  if (part.nodal_pressure) terms.has_volume = false;
  law.has_terms = terms.state > 0 || terms.has_volume || law.takes_pressure || !law.parameters.empty() || terms.flows ||
                  (law.shape != FanShape::fibre && terms.fibre_constant > 0);
  terms.is_principal = law.shape == FanShape::principal;
  terms.is_continued = continuation;
  const FanTermKernels<Real> kernels = fan_term_kernels<Real>(isa_);
  law.term_kernel = find_energy_law(material.law) ? kernels.of_energy(law.shape == FanShape::fibre)
                                                  : kernels.of_law(law_index(material.law), continuation);
}

/// Which constants are the fibre of active stress, and parameters that differ between elements: of the law, or of its
/// volume term, which takes κ from it.
template <class Real>
void FanForces<Real>::set_parameters(const FanPart& part, bool isochoric, Law& law) const {
  const Material& material = *part.material;
  const LawInfo& info = *find_law(material.law);
  const std::size_t of_shape = fan_constants(law.shape == FanShape::fibre);
  const std::vector<ParameterSlot> slots = parameter_slots(material, info);
  const bool without_kappa = isochoric && info.has_volume_term;
  for (const FieldParameter& field : material.fields) {
    const ParameterInfo* parameter = slots[field.parameter].info;
    const bool is_kappa = without_kappa && field.parameter == volume_parameter(material, info);
    if (is_kappa) law.terms.kappa_constant = of_shape + law.parameters.size();
    law.parameters.push_back(is_kappa || parameter->is_list()
                                 ? FanTerms<Real>::not_of_the_law
                                 : static_cast<std::size_t>(parameter - info.parameters.data()));
    law.fields.push_back(field.field);
  }
  law.terms.constants = of_shape + law.parameters.size();
  if (law.shape == FanShape::fibre) {
    law.terms.fibre_constant = fan_constants(false);
  } else if (material.gives_fibre()) {
    law.terms.fibre_constant = law.terms.constants;
    law.terms.constants += 3;
  }
}

template <class Real>
std::vector<FanTerms<Real>> FanForces<Real>::terms_of_parts(const Real* pressure) const {
  std::vector<FanTerms<Real>> result;
  for (const Law& law : laws_) {
    FanTerms<Real>& terms = result.emplace_back(law.terms);
    terms.branches = law.branches.data();
    terms.branch_count = law.branches.size();
    terms.parameters = law.parameters.data();
    terms.parameter_count = law.parameters.size();
    if (law.takes_pressure) terms.pressure = pressure;
  }
  return result;
}

template <class Real>
bool FanForces<Real>::update_laws(const std::vector<FanPart>& parts, bool continuation) {
  if (parts.size() != laws_.size()) return false;
  std::vector<Law> laws;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    laws.push_back(law_of(parts[p], continuation));
    const Law &now = laws.back(), &before = laws_[p];
    if (now.shape != before.shape || now.fibre != before.fibre || now.fibre_field != before.fibre_field ||
        now.fields != before.fields)
      return false;
  }
  laws_ = std::move(laws);
  forget_state();
  begin_step(step_);
  return true;
}

template <class Real>
bool FanForces<Real>::update_layout(const TetMesh& before, const TetMesh& mesh, const std::vector<FanPart>& parts,
                                    const std::vector<int>& origins, ThreadTeam& team) {
  if (parts.size() != laws_.size()) return false;
  std::vector<FanElements> elements;
  for (std::size_t p = 0; p < parts.size(); ++p) elements.push_back(elements_of(mesh, parts[p], laws_[p].shape));
  layout_ = std::make_shared<const FanLayout<Real>>(
      layout_->after_edit(before, mesh, elements, origins, lanes_of<Real>(isa_), team));
  forget_state();
  nodes_ = mesh.nodes.size();
  return true;
}

/// At least, so that each has some element_grain elements.
template <class Real>
std::size_t FanForces<Real>::blocks_a_thread() const {
  const std::size_t threads = std::max<std::size_t>(layout_->elements() / element_grain, 1);
  return std::max<std::size_t>(layout_->blocks.size() / threads, 1);
}

/// A block whose shared nodes get so many numbers each.
template <class Real>
FanBlock<Real> FanForces<Real>::block_at(std::size_t b, std::size_t numbers) {
  const FanLayout<Real>& fans = *layout_;
  const auto& at = fans.blocks[b];
  const NodeBlocks::Block& nodes = fans.nodes.blocks[b];
  return {&fans.size[at.group],
          at.groups,
          &fans.index[at.index],
          &fans.shape[at.shape],
          &fans.nodes.place[nodes.place],
          nodes.own,
          nodes.nodes,
          shared_force_.data() + numbers * nodes.shared_slot};
}

template <class Real>
bool FanForces<Real>::forces(const Real* x, Real* f, ThreadTeam& team, const Real* pressure) {
  assert(!needs_state());
  const FanLayout<Real>& fans = *layout_;
  const std::vector<FanTerms<Real>> terms = terms_of_parts(pressure);
  if (has_state()) state_.make_next();
  if (has_state() || has_flow()) {
    evaluated_x_.assign(x, x + 3 * nodes_);
    evaluated_ = true;
  }
  shared_force_.resize(3 * fans.nodes.shared_slots);
  std::atomic<bool> valid{true};
  team.parallel_for(fans.blocks.size(), blocks_a_thread(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t part = fans.blocks[b].part;
      const Law& law = laws_[part];
      const FanBlock<Real> block = block_at(b, 3);
      FanMemory<Real> memory;
      if (law.terms.state > 0) memory.state = state_.now(b), memory.next = state_.next(b);
      if (law.terms.flows) memory.shape = flow_.shape(b), memory.beyond = flow_.beyond_of(b);
      const bool defined = law.has_terms || law.terms.active != 0
                               ? law.term_kernel(law.law.get(), block, terms[part], memory, x, f)
                               : law.kernel(law.law.get(), block, x, f);
      if (!defined) valid.store(false, std::memory_order_relaxed);
    }
  });
  fans.nodes.template sum_shared<3>(shared_force_.data(), f, team);
  return valid;
}

template <class Real>
void FanForces<Real>::node_volumes(const Real* x, Real* sum, ThreadTeam& team) {
  const FanLayout<Real>& fans = *layout_;
  shared_force_.resize(3 * fans.nodes.shared_slots);
  const FanVolumeKernel<Real> kernel = fan_term_kernels<Real>(isa_).volumes;
  team.parallel_for(fans.blocks.size(), blocks_a_thread(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      kernel(block_at(b, 1), laws_[fans.blocks[b].part].terms.constants, x, sum);
    }
  });
  fans.nodes.template sum_shared<1>(shared_force_.data(), sum, team);
}

template <class Real>
bool FanForces<Real>::has_state() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const Law& law) { return law.terms.state > 0; });
}

template <class Real>
bool FanForces<Real>::has_flow() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const Law& law) { return law.terms.flows; });
}

template <class Real>
void FanForces<Real>::read_state(const std::vector<FanSlots<Real>>& slots) {
  if (has_state() && !state_.is_known()) state_.read(*layout_, lanes_of<Real>(isa_), terms_of_parts(), slots);
  if (has_flow() && !flow_.is_known()) flow_.read(*layout_, lanes_of<Real>(isa_), terms_of_parts(), slots);
  evaluated_ = false;
}

template <class Real>
bool FanForces<Real>::is_evaluated_at(const Real* x) const {
  return evaluated_ && std::memcmp(evaluated_x_.data(), x, sizeof(Real) * 3 * nodes_) == 0;
}

template <class Real>
void FanForces<Real>::put_rest_shapes(std::size_t part, const FanSlots<Real>& of_part,
                                      std::span<const std::size_t> slots) {
  if (slots.empty() || !flow_.is_known()) return;
  flow_.put(*layout_, lanes_of<Real>(isa_), part, of_part, slots);
  evaluated_ = false;
}

template <class Real>
void FanForces<Real>::write_state(const std::vector<FanSlots<Real>>& slots) const {
  state_.write(*layout_, lanes_of<Real>(isa_), terms_of_parts(), slots);
}

template <class Real>
Real FanForces<Real>::state_bound(const std::vector<FanSlots<Real>>& slots) const {
  assert(!needs_state());
  return has_state() ? state_.bound(*layout_, lanes_of<Real>(isa_), terms_of_parts(), slots, flow_) : Real(0);
}

template <class Real>
void FanForces<Real>::begin_step(Real h) {
  step_ = h;
  evaluated_ = false;
  for (Law& law : laws_) {
    law.terms.per_step = h > 0 ? 1 / h : 0;
    law.terms.weight = 0;
    law.branches.clear();
    for (const PronyTerm& term : law.relaxation) {
      law.branches.push_back(branch_during(static_cast<Real>(term.gamma), static_cast<Real>(term.tau), h));
      law.terms.weight += law.branches.back().gain;
    }
  }
}

template <class Real>
void FanForces<Real>::commit(const Real* x) {
  if (!has_state()) return;
  assert(!needs_state());
  if (!is_evaluated_at(x)) {
    ThreadTeam alone(1);
    std::vector<Real> unused(3 * nodes_);
    forces(x, unused.data(), alone);
  }
  state_.advance();
  evaluated_ = false;
}

template <class Real>
void FanForces<Real>::drop_scratch() {
  state_.drop_next();
  flow_.forget();
  evaluated_x_ = {};
  shared_force_ = {};
  evaluated_ = false;
}

template <class Real>
std::size_t FanForces<Real>::bytes() const {
  const FanLayout<Real>& fans = *layout_;
  return bytes_of(fans.blocks, fans.size, fans.index, fans.shape, fans.element, shared_force_, evaluated_x_) +
         fans.nodes.bytes() + state_.bytes() + flow_.bytes();
}

template class FanForces<float>;
template class FanForces<double>;

}  // namespace heml
