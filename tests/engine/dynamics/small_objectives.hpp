#pragma once
// Objectives for tests of solvers without a body.
#include <heml/dynamics/linear_solver.hpp>
#include <heml/mesh/generate.hpp>

namespace heml::test {

/// U = Σ_n w(x_n) + Σ k/2 |x_a−x_b|²: a potential w at every free node, and springs along the edges of a mesh.
class NodesAndSprings : public Objective {
 public:
  NodesAndSprings(const TetMesh& mesh, const FreeNodes& free, double k) : mesh_(mesh), free_(free), k_(k) {}

  bool residual(const Vector& x, Vector& r) override {
    r.setZero(x.size());
    each_edge([&](int a, int b) {
      const Vec3 pull = k_ * (x.segment<3>(3 * b) - x.segment<3>(3 * a));
      if (free_.number[static_cast<std::size_t>(a)] >= 0) r.segment<3>(3 * a) += pull;
      if (free_.number[static_cast<std::size_t>(b)] >= 0) r.segment<3>(3 * b) -= pull;
    });
    for (const int n : free_.node)
      for (int i = 0; i < 3; ++i) r[3 * n + i] -= slope(x[3 * n + i]);
    return true;
  }
  std::optional<double> value(const Vector& x) override {
    double sum = 0;
    each_edge([&](int a, int b) { sum += k_ / 2 * (x.segment<3>(3 * b) - x.segment<3>(3 * a)).squaredNorm(); });
    for (const int n : free_.node)
      for (int i = 0; i < 3; ++i) sum += well(x[3 * n + i]);
    return sum;
  }
  double value_round_off() const override { return 1e-14; }
  void linearise(const Vector& x, Projection projection = Projection::none) override {
    at_ = x;
    projected_ = projection == Projection::element;
  }
  void product(const Vector& dx, Vector& out) override {
    out.setZero(dx.size());
    each_edge([&](int a, int b) {
      const Vec3 pull = k_ * (dx.segment<3>(3 * b) - dx.segment<3>(3 * a));
      if (free_.number[static_cast<std::size_t>(a)] >= 0) out.segment<3>(3 * a) -= pull;
      if (free_.number[static_cast<std::size_t>(b)] >= 0) out.segment<3>(3 * b) += pull;
    });
    for (const int n : free_.node)
      for (int i = 0; i < 3; ++i) out[3 * n + i] += bend(at_[3 * n + i]) * dx[3 * n + i];
  }
  void add_stiffness(BlockMatrix& matrix) override {
    each_edge([&](int a, int b) {
      matrix.add_node(a, k_ * Mat3::Identity());
      matrix.add_node(b, k_ * Mat3::Identity());
      matrix.add_pair(a, b, -k_ * Mat3::Identity());
    });
    for (const int n : free_.node) matrix.add_node(n, bends(n));
  }

  bool assemble_single_precision(BsrMatrix& rows) override {
    rows.set_zero();
    each_edge([&](int a, int b) { rows.add_edge(a, b, k_ * Mat3::Identity()); });
    for (const int n : free_.node) rows.add_node(n, bends(n));
    return true;
  }

  virtual double well(double) const { return 0; }
  virtual double slope(double) const { return 0; }
  virtual double curvature(double) const { return 0; }

 private:
  Mat3 bends(int n) const { return Vec3(bend(at_[3 * n]), bend(at_[3 * n + 1]), bend(at_[3 * n + 2])).asDiagonal(); }
  double bend(double x) const { return projected_ ? std::max(curvature(x), 0.0) : curvature(x); }
  template <class Visit>
  void each_edge(const Visit& visit) const {
    for (const Tet& tet : mesh_.tets)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) visit(tet[a], tet[b]);
  }
  const TetMesh& mesh_;
  const FreeNodes& free_;
  double k_;
  Vector at_;
  bool projected_ = false;
};

/// A double well at every node, (x² − 1)²/4 per axis, concave near 0.
class Wells final : public NodesAndSprings {
 public:
  using NodesAndSprings::NodesAndSprings;
  double well(double x) const override { return (x * x - 1) * (x * x - 1) / 4; }
  double slope(double x) const override { return x * (x * x - 1); }
  double curvature(double x) const override { return 3 * x * x - 1; }
};

}  // namespace heml::test
