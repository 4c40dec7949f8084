#include <cmath>
#include <studies/mass_tensor.hpp>
#include <studies/naive.hpp>
#include <studies/translation_error.hpp>

namespace heml {
namespace {

template <class Real>
double relative_error(const std::vector<Real>& f, const std::vector<double>& reference) {
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    apart += std::pow(static_cast<double>(f[i]) - reference[i], 2);
    size += reference[i] * reference[i];
  }
  return std::sqrt(apart / size);
}

double size_of(const TetMesh& mesh) {
  Vec3 low = mesh.nodes.front(), high = low;
  for (const Vec3& X : mesh.nodes) low = low.cwiseMin(X), high = high.cwiseMax(X);
  return (high - low).maxCoeff();
}

}  // namespace

template <class Real>
std::vector<TranslationError> translation_errors(const BenchBody& body, const Material& stvk) {
  std::vector<double> reference(body.x.size());
  NaiveForces(body.mesh, stvk)(body.x.data(), reference.data());
  ElasticBody<Real> heml(body.mesh, std::vector<int>(body.mesh.tets.size(), 0), {stvk}, {});
  const MassTensor<Real> mass_tensor(body.mesh, stvk.parameters[0], stvk.parameters[1], MassTensorSums::without_zeros);
  ThreadTeam team(1);
  const Vec3 along = size_of(body.mesh) * Vec3(3, 2, 1).normalized();
  std::vector<Real> x(body.x.size()), f(x.size());
  std::vector<TranslationError> errors;
  for (const double sizes : {0.0, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = static_cast<Real>(body.x[i] + sizes * along[static_cast<int>(i % 3)]);
    TranslationError& error = errors.emplace_back();
    error.sizes = sizes;
    heml.forces(x.data(), f.data(), team);
    error.heml = relative_error(f, reference);
    mass_tensor.forces(x.data(), f.data());
    error.mass_tensor = relative_error(f, reference);
  }
  return errors;
}

template std::vector<TranslationError> translation_errors<float>(const BenchBody&, const Material&);
template std::vector<TranslationError> translation_errors<double>(const BenchBody&, const Material&);

}  // namespace heml
