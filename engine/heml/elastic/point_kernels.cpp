#include <heml/elastic/energy_term.hpp>
#include <heml/elastic/point_kernels.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/laws.hpp>
#include <heml/materials/parameter_slots.hpp>

namespace heml {

template <class Real>
PointBlock<Real> point_block(const ElementGroup<Real>& group, const PointLayout& layout, std::size_t number,
                             std::span<const PointParameter> parameters, const Real* kappa, Real* of_slot) {
  const PointLayout::Block& at = layout.blocks[number];
  const NodeBlocks::Block& nodes = layout.nodes.blocks[number];
  const std::size_t slot = element_points * at.first;
  PointBlock<Real> block{};
  block.elements = at.elements;
  block.index = &layout.index[at.index];
  for (std::size_t i = 0; i < 6; ++i) block.A[i] = group.A[i].data() + slot;
  block.volume = group.volume.data() + slot;
  for (std::size_t i = 0; i < 3; ++i) block.fibre[i] = group.fibre[i].empty() ? nullptr : &group.fibre[i][slot];
  for (const auto [field, parameter] : parameters) {
    block.parameter[block.parameters] = &group.parameters[field][slot];
    block.parameter_at[block.parameters++] = parameter;
  }
  block.kappa = kappa ? kappa + slot : nullptr;
  block.place = &layout.nodes.place[nodes.place];
  block.own = nodes.own;
  block.nodes = nodes.nodes;
  block.shared_force = of_slot + 3 * nodes.shared_slot;
  return block;
}

template <class Real>
PointTerms<Real> of_block(PointTerms<Real> terms, const PointLayout::Block& block) {
  const std::size_t slot = element_points * block.first;
  if (terms.before) terms.before += terms.state * slot, terms.next += terms.state * slot;
  if (terms.kappa_of) terms.kappa_of += slot;
  if (terms.mises) terms.mises += slot;
  return terms;
}

template <class Real>
PointForces<Real> point_forces(const Material& material, bool continuation, InstructionSet isa) {
  PointForces<Real> result;
  if (!has_kernel(material)) return result;
  result.instruction_set = resolve(isa);
  const LawInfo& info = *find_law(material.law);
  const std::vector<ParameterSlot> slots = parameter_slots(material, info);
  const bool isochoric =
      info.has_volume_term && (material.volume_term != VolumeTerm::quadratic || !material.relaxation.empty());
  const std::size_t kappa = isochoric ? *volume_parameter(material, info) : material.parameters.size();
  result.terms.is_continued = continuation;
  result.terms.mean_volume = material.volume_term;
  if (isochoric) {
    result.terms.has_volume = true;
    result.terms.volume = material.volume_term;
    result.terms.kappa = static_cast<Real>(material.parameters[kappa]);
  }
  for (std::size_t k = 0; k < material.fields.size(); ++k) {
    const ParameterInfo* parameter = slots[material.fields[k].parameter].info;
    if (isochoric && material.fields[k].parameter == kappa)
      result.kappa_field = k;
    else if (!parameter->is_list())
      result.parameters.push_back({k, static_cast<std::size_t>(parameter - info.parameters.data())});
  }
  if (find_energy_law(material.law)) {
    with_invariant_energy<Real>(material, [&]<class L>(const L& law) {
      result.law = std::make_shared<const L>(law);
#if HEML_X86_KERNELS
      if (result.instruction_set == InstructionSet::avx512)
        result.kernel = avx512_point_energy_kernel<Real>(L::uses_I4);
      else if (result.instruction_set == InstructionSet::avx2)
        result.kernel = avx2_point_energy_kernel<Real>(L::uses_I4);
#endif
    });
    return result;
  }
  with_law<Real>(material, continuation, [&]<class L>(L law) {
    if constexpr (L::has_volume_term)
      if (isochoric) law.kappa = 0;
    result.law = std::make_shared<const L>(law);
#if HEML_X86_KERNELS
    if (result.instruction_set == InstructionSet::avx512)
      result.kernel = avx512_point_kernel<Real>(law_index(L::name), continuation);
    else if (result.instruction_set == InstructionSet::avx2)
      result.kernel = avx2_point_kernel<Real>(law_index(L::name), continuation);
#endif
  });
  return result;
}

template PointBlock<float> point_block(const ElementGroup<float>&, const PointLayout&, std::size_t,
                                       std::span<const PointParameter>, const float*, float*);
template PointBlock<double> point_block(const ElementGroup<double>&, const PointLayout&, std::size_t,
                                        std::span<const PointParameter>, const double*, double*);
template PointTerms<float> of_block(PointTerms<float>, const PointLayout::Block&);
template PointTerms<double> of_block(PointTerms<double>, const PointLayout::Block&);
template PointForces<float> point_forces(const Material&, bool, InstructionSet);
template PointForces<double> point_forces(const Material&, bool, InstructionSet);

}  // namespace heml
