#pragma once
// Stiffness beside that of the elements: contact, a sum G Gᵀ of few rank-one terms, many times as stiff as tissue. The
// matrix of the elements (bsr_matrix.hpp) has no place for it where it couples nodes that share no element, and their
// preconditioner P (smoothed_aggregation.hpp) knows nothing of it: conjugate gradients would take iterations for each
// point that touches, some 300 for 17. So its product is a sum of its own, and the preconditioner becomes
//
//   (P + G Gᵀ)⁻¹ r = z − P⁻¹ G S⁻¹ Gᵀ z,    z = P⁻¹ r,    S = I + Gᵀ P⁻¹ G
//
// (Sherman-Morrison-Woodbury; G. Golub, C. Van Loan, Matrix Computations, 2013, 2.1.4). P treats the three axes alike,
// so P⁻¹ G takes one column of P⁻¹ for each node that a term pushes. A column is computed when its node is met first
// and kept until P changes.
#include <Eigen/Cholesky>
#include <heml/dynamics/objective.hpp>
#include <heml/dynamics/smoothed_aggregation.hpp>

namespace heml {

class LowRankUpdate {
 public:
  /// free and team must outlive this.
  LowRankUpdate(const FreeNodes& free, ThreadTeam& team) : free_(free), team_(team) {}

  /// To be called when P has changed: forgets columns and terms.
  void reset();
  void set(SmoothedAggregation& P, const std::vector<RankOneTerm>& terms);
  /// Of more terms the strongest are in the preconditioner; the matrix of so many is factored in some 20 ms.
  static constexpr std::size_t max_terms = 512;

  bool empty() const { return terms_.empty(); }

  /// q += G Gᵀ p, #free.
  void add_product(const MultiVector& p, MultiVector& q) const;

  /// From z = P⁻¹ r to (P + G Gᵀ)⁻¹ r without the weaker terms. z: #free; the other: 3 #V.
  void correct(MultiVector& z);
  void correct(Vector& z);

  std::size_t bytes() const;

 private:
  /// A term between rows of P.
  struct Term {
    int count;
    std::array<std::size_t, 4> at;  ///< places in rows_
    std::array<Vec3, 4> g;
    double sign;
  };
  bool is_held(int coordinate) const;
  void find_correction(SmoothedAggregation& P);
  void keep_strongest();
  void find_columns(SmoothedAggregation& P);
  double coupling(const Term& a, const Term& b) const;
  template <class Part>
  void find_forces(const Part& part);

  const FreeNodes& free_;
  ThreadTeam& team_;
  std::vector<std::vector<float>> columns_;  ///< of P⁻¹, by row; empty where not computed
  std::vector<std::size_t> rows_;            ///< those that terms push, ascending
  std::vector<Term> terms_, strong_;         ///< strong: those that correct() knows
  Eigen::MatrixXd inverse_;                  ///< of P: between rows_
  Eigen::LLT<Eigen::MatrixXd> S_;
  std::vector<Vec3> forces_;  ///< G S⁻¹ Gᵀ z on rows_
};

}  // namespace heml
