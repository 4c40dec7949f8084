#pragma once
// The kernels of every law at the points of quadratic elements: their tensions, for the stages of point_stages.hpp.
#include <heml/elastic/noting_energy.hpp>
#include <heml/elastic/point_stages.hpp>
#include <heml/materials/law_packs.hpp>
#include <heml/materials/laws.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

/// Writes the tensions of the four points. Parameters that differ are set in the law.
template <class P, class L>
void point_tensions(void* of_part, const PointBlock<Lane<P>>& block, typename PointStages<P>::Elements& of,
                    Mask<P>& valid) {
  L& law = *static_cast<L*>(of_part);
#pragma GCC unroll 1
  for (std::size_t q = 0; q < 4; ++q) {
    PackedPoint<P>& point = of.point[q];
    if constexpr (std::size(L::parameters) > 0)
      for (std::size_t k = 0; k < block.parameters; ++k)
        law.*L::parameters[block.parameter_at[k]].member = of.parameter[k][q];
    ElementKinematics<P> at;
    for (std::size_t i = 0; i < 6; ++i) at.G[i].v = point.of.G[i].v;
    at.at.J.v = point.of.at.J.v;
    put_invariants<L::uses_I2, L::uses_I4, FibreShearLaw<L>>(point.rest, at);
    if constexpr (!L::always_valid) valid = valid && law.valid(at.at);
    const Tensions<P> t = tensions(law, at, point.rest);
    for (std::size_t i = 0; i < 6; ++i) point.t.T[i].v = t.T[i].v;
    point.t.wJ.v = L::uses_J ? t.wJ.v : P(0).v;
  }
}

/// Kernel of the law with that index in LawList, on packs of `bytes`.
template <class Real, class Family, std::size_t bytes>
PointKernel<Real> point_force_kernel(std::size_t law, bool continued) {
  constexpr int lanes = bytes / sizeof(Real);
  using P = Pack<Real, lanes, Family>;
  PointKernel<Real> kernel = nullptr;
  visit_law(law, continued, [&]<class Tag, bool with>(Tag, std::bool_constant<with>) {
    using One = typename Tag::template Law<Real, with>;
    using Many = typename Tag::template Law<P, with>;
    static_assert(std::size(Many::parameters) <= max_point_parameters);
    kernel = [](const void* scalar, const PointBlock<Real>& block, const PointTerms<Real>& terms, const Real* x,
                Real* f) {
      Many many = broadcast<Many, P>(*static_cast<const One*>(scalar));
      return PointStages<P>::run({&many, point_tensions<P, Many>, Many::uses_J, Many::uses_I4}, block, terms, x, f);
    };
  });
  return kernel;
}

template <class P, bool with_fibre>
bool energy_at_points(const void* law, const PointBlock<Lane<P>>& block, const PointTerms<Lane<P>>& terms,
                      const Lane<P>* x, Lane<P>* f) {
  using Many = NotingEnergy<P, with_fibre>;
  Mask<P> defined = true;
  const auto* numbers = static_cast<const InvariantEnergy<Lane<P>, false, with_fibre>*>(law);
  Many noting{numbers->template broadcast<P>(), &defined};
  const bool valid = PointStages<P>::run({&noting, point_tensions<P, Many>, true, with_fibre}, block, terms, x, f);
  return valid && defined.all();
}

/// Kernel of laws by expression of invariants.
template <class Real, class Family, std::size_t bytes>
PointKernel<Real> point_energy_kernel(bool with_fibre) {
  using P = Pack<Real, bytes / sizeof(Real), Family>;
  return with_fibre ? energy_at_points<P, true> : energy_at_points<P, false>;
}

}  // namespace
}  // namespace heml
