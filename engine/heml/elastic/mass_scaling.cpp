#include <algorithm>
#include <cmath>
#include <heml/elastic/mass_scaling.hpp>
#include <numeric>

namespace heml {

template <class Real>
std::vector<Real> mass_factors(const std::vector<Real>& bounds, const std::vector<Real>& masses, double share) {
  const double allowed = share * std::accumulate(masses.begin(), masses.end(), 0.0);
  if (!(allowed > 0) || !std::all_of(bounds.begin(), bounds.end(), [](Real b) { return std::isfinite(b); })) return {};
  std::vector<std::size_t> order(bounds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bounds[a] > bounds[b]; });
  // T of the first k nodes is (Σ m B) / (allowed + Σ m); k grows while the next bound is above it.
  double mass = 0, weighted = 0, target = 0;
  for (const std::size_t n : order) {
    const auto bound = static_cast<double>(bounds[n]), m = static_cast<double>(masses[n]);
    if (bound <= target) break;
    mass += m, weighted += m * bound;
    target = weighted / (allowed + mass);
  }
  if (!(target > 0)) return {};
  std::vector<Real> factors(bounds.size(), 1);
  for (std::size_t n = 0; n < bounds.size(); ++n)
    factors[n] = std::max(static_cast<Real>(static_cast<double>(bounds[n]) / target), Real(1));
  return factors;
}

template std::vector<float> mass_factors(const std::vector<float>&, const std::vector<float>&, double);
template std::vector<double> mass_factors(const std::vector<double>&, const std::vector<double>&, double);

}  // namespace heml
