#include <cmath>
#include <heml/elastic/group_law.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/materials/laws.hpp>

namespace heml {
namespace {

/// Cauchy stress is J⁻¹ F S Fᵀ; with S = a I + b C + wJ J C⁻¹ its invariants follow from those of C alone:
/// J σ = a B + b B² + wJ J I, B = F Fᵀ, which has the eigenvalues of C. Von Mises: √(3/2) |dev σ|.
template <class Real, class L>
ElementState<Real> state_of(const L& law, const Invariants<Real>& at) {
  const Slopes<Real> s = law.slopes(at);
  const Real a = 2 * (s.w1 + s.w2 * at.I1), b = -2 * s.w2;
  // Traces of powers of B from its invariants (Cayley–Hamilton), I3 = J².
  const Real I1 = at.I1, I2 = at.I2, I3 = at.J * at.J;
  const Real t1 = I1, t2 = I1 * I1 - 2 * I2, t3 = I1 * t2 - I2 * t1 + 3 * I3, t4 = I1 * t3 - I2 * t2 + I3 * t1;
  const Real trace = a * t1 + b * t2, square = a * a * t2 + 2 * a * b * t3 + b * b * t4;
  const Real deviator = std::max(square - trace * trace / 3, Real(0));
  // Largest eigenvalue of a symmetric 3×3 from its invariants (Smith 1961).
  const Real mean = t1 / 3, p = std::sqrt(std::max((t2 / 3 - mean * mean) / 2, Real(0)));
  Real largest = mean;
  if (p > 0) {
    const Real det = I3 - mean * I2 + mean * mean * I1 - mean * mean * mean;  // det(C − mean I)
    const Real r = std::clamp(det / (2 * p * p * p), Real(-1), Real(1));
    largest = mean + 2 * p * std::cos(std::acos(r) / 3);
  }
  return {at.J, std::sqrt(std::max(largest, Real(0))), std::sqrt(Real(1.5) * deviator) / std::abs(at.J)};
}

// The loops of every step again for wider vectors. The same operations in the same order and none contracted: the same
// bits.
#if defined(__x86_64__)
template <class Real, class L>
[[gnu::target("avx2")]] bool group_forces_avx2(const L& law, const ElementGroup<Real>& group, const Real* x,
                                               std::size_t begin, std::size_t end, Real* corner) {
  return group_forces<Real>(law, group, x, begin, end, corner);
}
template <class Real, class L>
[[gnu::target("avx2")]] Real group_frequency_bound_avx2(const L& law, const ElementGroup<Real>& group, const Real* x,
                                                        std::size_t begin, std::size_t end) {
  return group_frequency_bound<Real>(law, group, x, begin, end);
}
const bool has_avx2 = __builtin_cpu_supports("avx2");
#endif

template <class Real, Law<Real> L>
class LawLoops final : public GroupLaw<Real> {
 public:
  explicit LawLoops(const L& law) : law_(law) {}

  bool forces(const ElementGroup<Real>& group, const Real* x, std::size_t begin, std::size_t end,
              Real* corner) const override {
#if defined(__x86_64__)
    if (has_avx2) return group_forces_avx2<Real>(law_, group, x, begin, end, corner);
#endif
    return group_forces<Real>(law_, group, x, begin, end, corner);
  }

  Real frequency_bound(const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                       std::size_t end) const override {
#if defined(__x86_64__)
    if (has_avx2) return group_frequency_bound_avx2<Real>(law_, group, x, begin, end);
#endif
    return group_frequency_bound<Real>(law_, group, x, begin, end);
  }

  double energy(const ElementGroup<Real>& group, const Real* x) const override {
    double sum = 0;
    for_each_link(group, x, 0, group.size(), [&](std::size_t s, const Real*, const Link<Real>& link) {
      sum += static_cast<double>(group.volume[s]) * static_cast<double>(law_.energy(link.at));
    });
    return sum;
  }

  std::size_t first_invalid(const ElementGroup<Real>& group, const Real* x) const override {
    std::size_t first = group.size();
    for_each_link(group, x, 0, group.size(), [&](std::size_t s, const Real*, const Link<Real>& link) {
      if (first == group.size() && !law_.valid(link.at)) first = s;
    });
    return first;
  }

  void states(const ElementGroup<Real>& group, const Real* x, ElementState<Real>* out) const override {
    for_each_link(group, x, 0, group.size(),
                  [&](std::size_t s, const Real*, const Link<Real>& link) { out[s] = state_of<Real>(law_, link.at); });
  }

 private:
  L law_;
};

}  // namespace

template <class Real>
std::unique_ptr<GroupLaw<Real>> make_group_law(const Material& material, bool continuation) {
  std::unique_ptr<GroupLaw<Real>> loops;
  with_law<Real>(material, continuation,
                 [&]<class L>(const L& law) { loops = std::make_unique<LawLoops<Real, L>>(law); });
  return loops;
}

template std::unique_ptr<GroupLaw<float>> make_group_law(const Material&, bool);
template std::unique_ptr<GroupLaw<double>> make_group_law(const Material&, bool);

}  // namespace heml
