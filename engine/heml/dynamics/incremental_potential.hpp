#pragma once
// The incremental potential Φ(x) = a/2 ‖x − y‖²_M + U(x), which a stage of any implicit method minimises
// (implicit_stage.hpp).
#include <heml/dynamics/objective.hpp>
#include <heml/elastic/bsr_matrix.hpp>

namespace heml {

class IncrementalPotential final : public Objective {
 public:
  /// potential: U. mass: 3 #V, kg (each node's three times), 0 where not free or held. All must outlive this.
  IncrementalPotential(Objective& potential, const Vector& mass, const FreeNodes& free)
      : potential_(potential), mass_(mass), free_(free) {}

  /// a: 1/s². y: 3 #V, m.
  void set(double a, Vector y) {
    a_ = a;
    y_ = std::move(y);
  }

  bool residual(const Vector& x, Vector& r) override {
    const bool defined = potential_.residual(x, r);
    r.array() -= a_ * mass_.array() * (x - y_).array();
    return defined;
  }
  std::optional<double> value(const Vector& x) override {
    const auto U = potential_.value(x);
    if (!U) return U;
    return *U + a_ / 2 * (mass_.array() * (x - y_).array().square()).sum();
  }
  double value_round_off() const override { return potential_.value_round_off(); }
  bool is_at_round_off(const Vector& r) const override { return potential_.is_at_round_off(r); }
  bool refine_precision() override { return potential_.refine_precision(); }
  bool inverts_elements(const Vector& from, const Vector& to) const override {
    return potential_.inverts_elements(from, to);
  }
  void linearise(const Vector& x, Projection projection = Projection::none) override {
    potential_.linearise(x, projection);
  }
  void step_taken(double part) override { potential_.step_taken(part); }
  void product(const Vector& dx, Vector& out) override {
    potential_.product(dx, out);
    out.array() += a_ * mass_.array() * dx.array();
  }
  bool is_symmetric() const override { return potential_.is_symmetric(); }
  void add_stiffness(BlockMatrix& matrix) override {
    potential_.add_stiffness(matrix);
    for (const int n : free_.node) matrix.add_diagonal(n, a_ * mass_of_node(mass_, n));
  }
  void add_coupled_pairs(std::vector<std::array<int, 2>>& pairs) const override { potential_.add_coupled_pairs(pairs); }
  bool assemble_single_precision(BsrMatrix& rows) override {
    if (!potential_.assemble_single_precision(rows)) return false;
    for (const int n : free_.node) rows.add_diagonal(n, a_ * mass_of_node(mass_, n));
    return true;
  }
  void add_rank_one_terms(std::vector<RankOneTerm>& terms) const override { potential_.add_rank_one_terms(terms); }

 private:
  Objective& potential_;
  const Vector& mass_;
  const FreeNodes& free_;
  double a_ = 0;
  Vector y_;
};

}  // namespace heml
