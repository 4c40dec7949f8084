#pragma once
// Loss of precision when a body is translated (Goulette & Chendeb 2006, section 3.2): HEML works with differences of
// positions, Mass-Tensor with displacements from the rest shape.
#include <studies/bench_bodies.hpp>
#include <vector>

namespace heml {

struct TranslationError {
  double sizes;              ///< translation, in multiples of the body's size
  double heml, mass_tensor;  ///< ‖f − f₀‖ / ‖f₀‖
};

/// Force errors of a deformed body of Saint Venant–Kirchhoff translated by 0, 1, 10 … 1e6 times its size along (3, 2,
/// 1). Positions are rounded to Real after the translation; that part of the error is common to both methods. f₀:
/// forces of the naive loop, in double, before the translation.
template <class Real>
std::vector<TranslationError> translation_errors(const BenchBody& body, const Material& stvk);

}  // namespace heml
