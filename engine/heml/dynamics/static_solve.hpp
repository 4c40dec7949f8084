#pragma once
// Static equilibrium of a body whose motions and loads are ramped together from 0 to 1, in increments of its own
// choice:
//
//   whole load at once ──► Newton ──► reached, longer increments
//                            │ fails: half the increment
//                            └ ... too short: relaxation in pseudo-time, Φ = a/2 ‖x − y‖²_M + U with falling a, which
//                              walks through a snap to the next stable state; fails: no equilibrium, last good state
//                              kept
#include <atomic>
#include <heml/dynamics/newton.hpp>
#include <optional>

namespace heml {

/// An objective that depends on the fraction of a load.
class LoadDependentObjective : public Objective {
 public:
  /// Every call after it is for that fraction, 0 to 1.
  virtual void set_load(double fraction) = 0;
  /// Puts the held nodes of x where they are at a fraction.
  virtual void apply_constraints(double fraction, Vector& x) const = 0;
  /// How far the last state residual() saw, with its residual r, is from equilibrium: relative to what the body
  /// carries.
  virtual double relative_residual(const Vector& r) const = 0;
  /// Whether an equilibrium is one the load leads to: no element turned inside out.
  virtual bool is_admissible(const Vector& x) const = 0;
  /// Whether what it took for granted of a solution does not hold of x: then it is to be solved again from there.
  virtual bool update_lagged(const Vector&) { return false; }
  /// Keeps an equilibrium: what remembers goes on from it.
  virtual void accept(const Vector& x) = 0;
};

/// When a state counts as an equilibrium: its imbalance is within the tolerance, or, unless strict, as small as
/// round-off lets it become: of bodies with very stiff parts, or large ones in float, nothing more can be asked.
struct StaticTolerance {
  double tolerance;
  bool strict;
};

class StaticSolve {
 public:
  /// start: 3 #V, the state at load 0. mass: 3 #V, kg, 0 where not free. inertia: 1/s², of the scalar matrix that
  /// preconditions; 0 where the body is held. All must outlive this.
  StaticSolve(LoadDependentObjective& body, LinearSolver& linear, const Vector& mass, const FreeNodes& free,
              StaticTolerance limit, double inertia, Vector start);

  /// Goes on to a fraction of the load. Returns false where no equilibrium is found, or when told to stop: load() and
  /// x() are then the last ones found.
  bool load_to(double fraction, const std::atomic<bool>& stop);

  /// What acts on the body has changed: the next load_to() solves anew, even where it is.
  void invalidate() { solved_ = false; }

  const Vector& x() const { return x_; }
  const Vector& tried() const { return tried_; }  ///< where the last increment was to begin
  double load() const { return load_; }
  double relative_residual() const { return relative_residual_; }  ///< of x()
  /// Imbalance beyond which round-off did not let the last attempt come; none where it ended otherwise.
  std::optional<double> round_off() const { return round_off_; }
  long increments() const { return increments_; }
  long iterations() const { return iterations_; }  ///< of Newton, those of failed increments too

 private:
  bool increment(double next);
  Vector predict(double next);
  bool solve(Vector& x);
  bool is_enough(const NewtonResult& newton, const Vector& x);
  bool relax(double next);
  bool keep(double next, const Vector& x);

  LoadDependentObjective& body_;
  LinearSolver& linear_;
  const Vector& mass_;
  const FreeNodes& free_;
  double inertia_;
  StoppingCriterion stop_;
  bool strict_;
  Vector x_, tried_;
  std::optional<double> round_off_;
  double load_ = 0, step_ = 1, relative_residual_ = 0;
  bool solved_ = false;  ///< whether x_ is an equilibrium at load_
  int last_iterations_ = 0;
  long increments_ = 0, iterations_ = 0;
};

}  // namespace heml
