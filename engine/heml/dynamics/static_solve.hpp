#pragma once
// Static equilibrium of a body whose motions and loads are ramped together from 0 to 1, in adaptive increments:
//
//   whole load at once ──► Newton ──► reached, longer increments
//                            │ fails: half the increment
//                            └ ... too short: relaxation in pseudo-time, Φ = a/2 ‖x − y‖²_M + U with falling a, which
//                              passes a snap-through to the next stable state; fails: no equilibrium, last good state
//                              kept, and approached as near as min_limit_increment if asked to (approach_limit). A
//                              body in float that fails begins again in double
#include <atomic>
#include <heml/dynamics/newton.hpp>
#include <optional>

namespace heml {

/// An objective that depends on a load fraction.
class LoadDependentObjective : public Objective {
 public:
  /// Sets the load fraction, 0 to 1, for the calls that follow.
  virtual void set_load(double fraction) = 0;
  /// Moves the constrained nodes of x to their positions at a load fraction.
  virtual void apply_constraints(double fraction, Vector& x) const = 0;
  /// Relative residual of the last state passed to residual(), which gave r: ‖r‖ over the larger of the norms of
  /// external forces and reactions.
  virtual double relative_residual(const Vector& r) const = 0;
  /// Whether an equilibrium is acceptable: no inverted element.
  virtual bool is_admissible(const Vector& x) const = 0;
  /// Updates quantities that are constant during a solve (of contacts). Returns whether they changed, so that x must be
  /// solved again.
  virtual bool update_lagged(const Vector&) { return false; }
  /// Accepts an equilibrium: commits internal state and contacts at x.
  virtual void accept(const Vector& x) = 0;
};

/// A state is an equilibrium if its relative residual is within the tolerance. Unless strict, a larger residual is
/// accepted if it is round-off, as in bodies with very stiff parts or large ones in float.
struct StaticTolerance {
  double tolerance;
  bool strict;
};

/// How far a static solve has come.
class StaticSolveMemory {
 protected:
  explicit StaticSolveMemory(Vector start) : x_(std::move(start)) {}

  Vector x_, initial_guess_;
  std::optional<double> round_off_;
  double load_ = 0, step_ = 1, relative_residual_ = 0;
  bool solved_ = false;  ///< whether x_ is an equilibrium at load_
  int last_iterations_ = 0;
  bool stalled_ = false;  ///< whether the last attempt stalled
  long increments_ = 0, iterations_ = 0;
};

class StaticSolve : private StaticSolveMemory {
 public:
  struct Snapshot {
    StaticSolveMemory memory;
    StaticTolerance limit;
    double inertia;
  };
  /// start: 3 #V, m, the state at load 0. mass: 3 #V, kg, 0 where not free. inertia: a (1/s²) of the scalar matrix that
  /// preconditions; 0 if the body is constrained. body, linear, mass and free must outlive this.
  StaticSolve(LoadDependentObjective& body, LinearSolver& linear, const Vector& mass, const FreeNodes& free,
              StaticTolerance limit, double inertia, Vector start);
  /// Goes on from where the solve of the snapshot was.
  StaticSolve(LoadDependentObjective& body, LinearSolver& linear, const Vector& mass, const FreeNodes& free,
              const Snapshot& snapshot)
      : StaticSolve(body, linear, mass, free, snapshot.limit, snapshot.inertia, {}) {
    StaticSolveMemory::operator=(snapshot.memory);
  }
  Snapshot snapshot() const { return {*this, {stop_.limit, strict_}, inertia_}; }

  /// Continues to a load fraction. Returns false if no equilibrium is found or `stop` is set; load() and x() are then
  /// those of the last equilibrium.
  bool load_to(double fraction, const std::atomic<bool>& stop);

  /// Where load_to() has failed: goes on to the end of the path of equilibria, by increments halved down to
  /// min_limit_increment. Returns the lowest eigenvalue of the stiffness there, over that at rest (3 #V, m): 0 at a
  /// limit point or a bifurcation, beyond which no stable equilibrium continues the path. None where it is not
  /// positive.
  std::optional<double> approach_limit(const Vector& rest, const std::atomic<bool>& stop);

  /// To be called when loads change: the next load_to() solves again, also at the same fraction.
  void invalidate() { solved_ = false; }

  const Vector& x() const { return x_; }
  const Vector& initial_guess() const { return initial_guess_; }  ///< start of the last increment's iterations
  double load() const { return load_; }
  double relative_residual() const { return relative_residual_; }  ///< of x()
  /// Relative residual at which round-off ended the last attempt; none if it ended otherwise.
  std::optional<double> round_off() const { return round_off_; }
  long increments() const { return increments_; }
  long iterations() const { return iterations_; }  ///< of Newton, including failed increments

 private:
  std::optional<double> lowest_stiffness(const Vector& x);
  /// load_to() from where it is; false where no equilibrium is found or `stop` is set.
  bool follow_path(double fraction, const std::atomic<bool>& stop);
  /// Asks for double. Returns whether that changes anything.
  bool refine();
  bool increment(double next);
  Vector predict(double next);
  bool is_far(const Vector& start);
  bool solve(Vector& x);
  bool is_converged(const NewtonResult& newton, const Vector& x);
  bool relax(double next);
  bool keep(double next, const Vector& x);

  LoadDependentObjective& body_;
  LinearSolver& linear_;
  const Vector& mass_;
  const FreeNodes& free_;
  double inertia_;
  StoppingCriterion stop_;
  bool strict_;
  bool refined_ = false;  ///< whether the load_to() under way has asked for double
};

}  // namespace heml
