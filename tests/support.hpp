#pragma once
// Shared by several tests: seeded random vectors, rotations and deformation gradients.
#include <Eigen/Geometry>
#include <heml/math/types.hpp>
#include <random>

namespace heml::test {

/// Uniform in [low, high), the same on every machine (std distributions are not).
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

inline Vec3 random_vector(std::mt19937_64& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

inline Mat3 random_rotation(std::mt19937_64& random) {
  const Vec3 axis = random_vector(random, 1) + Vec3(0, 0, 2);
  return Eigen::AngleAxisd(uniform(random, -3, 3), axis.normalized()).toRotationMatrix();
}

/// R1 diag(stretches) R2 with random rotations and principal stretches in [low, high).
inline Mat3 random_gradient(std::mt19937_64& random, double low, double high) {
  const Vec3 stretches(uniform(random, low, high), uniform(random, low, high), uniform(random, low, high));
  return random_rotation(random) * stretches.asDiagonal() * random_rotation(random);
}

}  // namespace heml::test
