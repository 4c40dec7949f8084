#include <algorithm>
#include <cmath>
#include <heml/elastic/node_bounds.hpp>
#include <heml/math/bytes.hpp>
#include <numeric>

namespace heml {

template <class Real>
void NodeBounds<Real>::forget() {
  known_ = Known::nothing;
}

template <class Real>
void NodeBounds<Real>::begin(std::size_t nodes, int steps, Real bearable) {
  if (bound_.size() != nodes) forget();
  if (known_ == Known::nothing) {
    bound_.resize(nodes);
    seen_.resize(nodes);
    age_.assign(nodes, 0);
    growth_.assign(nodes / neighbourhood + 1, 0);
    due_.resize(nodes);
    std::iota(due_.begin(), due_.end(), 0);
    return;
  }
  due_.clear();
  const Real fades = std::max(Real(0), 1 - static_cast<Real>(steps) / max_age);
  Real fastest = 0;
  for (Real& growth : growth_) {
    // What grew before may grow still where nobody looked: it counts until all have been looked at.
    growth *= fades;
    fastest = std::max(fastest, growth);
  }
  std::size_t next_watched = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    const int age = std::min(age_[n] + steps, max_age);
    age_[n] = static_cast<std::uint8_t>(age);
    const bool is_watched = next_watched < watched_.size() && watched_[next_watched] == static_cast<int>(n);
    if (is_watched) ++next_watched;
    const Real growth = std::max(growth_[n / neighbourhood], fastest * static_cast<Real>(elsewhere));
    const Real room = std::max(largest_, bearable) - bound_[n];
    const bool may_matter = !(2 * static_cast<Real>(age) * growth < room) || bound_[n] == largest_;
    if (known_ == Known::bounds || is_watched || age == max_age || may_matter) due_.push_back(static_cast<int>(n));
  }
}

template <class Real>
Real NodeBounds<Real>::end() {
  if (due_.size() == bound_.size()) std::fill(growth_.begin(), growth_.end(), Real(0));  // all are known anew
  for (const int n : due_) {
    const auto k = static_cast<std::size_t>(n);
    Real& growth = growth_[k / neighbourhood];
    if (known_ != Known::nothing)
      growth = std::max(growth, (seen_[k] - bound_[k]) / static_cast<Real>(std::max<int>(age_[k], 1)));
    bound_[k] = seen_[k];
    age_[k] = 0;
  }
  known_ = known_ == Known::nothing ? Known::bounds : Known::bounds_and_growth;
  largest_ = 0;
  for (const Real bound : bound_) largest_ = bound > largest_ || std::isnan(bound) ? bound : largest_;
  return largest_;
}

template <class Real>
std::size_t NodeBounds<Real>::largest_node() const {
  const auto is_it = [this](Real bound) { return bound == largest_ || std::isnan(bound); };
  return static_cast<std::size_t>(std::find_if(bound_.begin(), bound_.end(), is_it) - bound_.begin());
}

template <class Real>
std::size_t NodeBounds<Real>::bytes() const {
  return bytes_of(bound_, seen_, growth_, age_, watched_, due_);
}

template class NodeBounds<float>;
template class NodeBounds<double>;

}  // namespace heml
