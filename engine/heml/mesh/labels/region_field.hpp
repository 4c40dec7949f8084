#pragma once
// A division of space into regions, as the lattice needs it: which region a point lies in, and where two of them meet.
#include <heml/math/types.hpp>

namespace heml {

class RegionField {
 public:
  virtual ~RegionField() = default;
  /// The region of a point (m); 0: outside.
  virtual int label_at(const Vec3& x) const = 0;
  /// How much region a outweighs region b at a point: positive in a, negative in b.
  virtual double difference(int a, int b, const Vec3& x) const = 0;
};

}  // namespace heml
