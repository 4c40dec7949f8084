#pragma once
// What precision is lost when a body travels (Goulette & Chendeb 2006, section 3.2): HEML works with differences of
// positions, Mass-Tensor with displacements from the rest shape.
#include <studies/bench_bodies.hpp>
#include <vector>

namespace heml {

struct TranslationError {
  double sizes;              ///< how far the body was carried, in sizes of its own
  double heml, mass_tensor;  ///< ‖f − f₀‖ / ‖f₀‖
};

/// Of a deformed body of Saint Venant–Kirchhoff carried 0, 1, 10 … 1e6 of its size along (3, 2, 1). Positions are
/// rounded to Real after the translation, so some error is theirs and no method's. f₀: the naive loop's, in double,
/// where the body was.
template <class Real>
std::vector<TranslationError> translation_errors(const BenchBody& body, const Material& stvk);

}  // namespace heml
