#include <Eigen/Dense>
#include <algorithm>
#include <heml/elastic/group_loops.hpp>
#include <heml/elastic/step_weights.hpp>

namespace heml {
namespace {

constexpr std::size_t weights_grain = 500;
constexpr int rounds = 3,
              quadratic_rounds = 2;    // each takes half of what is left to gain; of quadratic ones it is dear
constexpr double least_change = 0.25;  // of a weight in a round

using Matrix10 = Eigen::Matrix<double, 10, 10>;

/// Σ_q B_qᵀPB_q / 16: points of a quarter of the mass each, on four virtual corners, whose mean is not strained.
Matrix10 strained_mass() {
  Matrix10 sum = Matrix10::Zero();
  for (std::size_t q = 0; q < element_points; ++q) {
    Eigen::Matrix<double, 4, 10> B = Eigen::Matrix<double, 4, 10>::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      for (const auto& [node, weight] : virtual_corner(q, i)) B(static_cast<int>(i), static_cast<int>(node)) += weight;
    B.rowwise() -= B.colwise().mean().eval();
    sum += B.transpose() * B / 16;
  }
  return sum;
}

/// λ_max(Z⁻¹M⁻¹ Σ_q BᵀPB M_q) over that of z = 1, frequency_ratio.
template <class Real>
Real quadratic_factor(const QuadraticNodes& nodes, const std::vector<Real>& weights) {
  static const Matrix10 mass = strained_mass();
  Eigen::Matrix<double, 10, 1> scale;
  for (int a = 0; a < 10; ++a) {
    const double w = static_cast<double>(weights[static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)])]);
    scale[a] = std::sqrt(w * (a < 4 ? 36 : 27.0 / 4));
  }
  const Matrix10 scaled = scale.asDiagonal() * mass * scale.asDiagonal();
  const double largest =
      Eigen::SelfAdjointEigenSolver<Matrix10>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  constexpr double round_off = 16 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  return static_cast<Real>(largest / frequency_ratio * (1 + round_off));
}

/// b of an element at rest, 1/s²: V (λ (div u)² + 2μ |sym ∇u|²) ≤ b m |u|².
template <class Real>
Real bound_at_rest(const StiffElements<Real>& of, const Real A[6], const CornerWeights<Real>& weights) {
  return 4 / of.group->density *
         (static_cast<Real>(of.lame) * over_corners(A, weights) +
          2 * static_cast<Real>(of.shear) * max_gradient(A, weights));
}

}  // namespace

template <class Real>
StepWeights<Real> find_step_weights(const std::vector<StiffElements<Real>>& parts, const BodyLayout<Real>& layout,
                                    ThreadTeam& team) {
  StepWeights<Real> weights;
  std::vector<Real>& w = weights.node;
  w.assign(layout.nodes(), 1);
  const bool quadratic = layout.virtual_corners.has_value();
  if (quadratic) weights.factor.assign(layout.elements(), 1);
  std::vector<Real> mass(layout.bounded_elements(), 0), of_points(weights.factor.size(), 0), stiffness(mass.size(), 0);
  std::vector<Real> bound(w.size(), 0);

  const auto evaluate = [&](const StiffElements<Real>& part, std::size_t s, bool first) {
    const ElementGroup<Real>& group = *part.group;
    const std::size_t e = layout.bounded_element(group, s);
    if (first)
      for (std::size_t q = s; q < s + (quadratic ? element_points : 1); ++q) {
        mass[e] += group.density * group.volume[q];
        if (!quadratic) continue;
        const Real of_point = bound_at_rest<Real>(part, rest_shape(group, q).A, {});
        of_points[e] = std::max(of_points[e], of_point);
      }
    const Real b = quadratic ? of_points[e] * weights.factor[e]
                             : bound_at_rest(part, rest_shape(group, s).A, weights_of_slot(group, w.data(), s));
    stiffness[e] = b * mass[e];
  };
  const auto find_factors = [&] {
    team.parallel_for(weights.factor.size(), weights_grain / 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        weights.factor[e] = quadratic_factor(layout.virtual_corners->nodes_of(e), w);
    });
  };
  const std::size_t each = quadratic ? element_points : 1;
  for (int round = 0; round < (quadratic ? quadratic_rounds : rounds); ++round) {
    if (quadratic && round > 0) find_factors();
    for (const StiffElements<Real>& part : parts)
      team.parallel_for(part.group->size() / each, weights_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) evaluate(part, each * k, round == 0);
      });
    team.parallel_for(w.size(), weights_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        Real sum = 0, all = 0;
        layout.each_element_at(n, [&](std::size_t e) { sum += stiffness[e], all += mass[e]; });
        bound[n] = all > 0 ? sum / (all * w[n]) : 0;
      }
    });
    const Real largest = *std::max_element(bound.begin(), bound.end());
    if (!(largest > 0)) break;  // springs alone
    for (std::size_t n = 0; n < w.size(); ++n) w[n] *= std::max(bound[n] / largest, static_cast<Real>(least_change));
  }
  if (quadratic) find_factors();
  return weights;
}

template StepWeights<float> find_step_weights(const std::vector<StiffElements<float>>&, const BodyLayout<float>&,
                                              ThreadTeam&);
template StepWeights<double> find_step_weights(const std::vector<StiffElements<double>>&, const BodyLayout<double>&,
                                               ThreadTeam&);

}  // namespace heml
