#pragma once
// A body with all that acts on it, as solvers see it (dynamics/objective.hpp): elastic energy and what remembers,
// gravity, dead loads, pressure, grasps, contact. Inertia comes on top (dynamics/incremental_potential.hpp).
//
// Pressure follows the surface and has no potential in general: with it value() has nothing to say, products are not
// symmetric, and the assembled stiffness has the symmetric part of pressure's.
//
// A body in float is evaluated in float until a solve finds its values to be round-off (dynamics/newton.cpp). Elastic
// forces, energy and stiffness are then those of the same elements in double, at positions that are not rounded:
//
//   float ──► values are round-off ──► double, for this solve and the next steps_in_double steps ──► float
#include <deque>
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/static_solve.hpp>
#include <heml/elastic/body.hpp>
#include <heml/tools/contact_potential.hpp>
#include <heml/tools/grasp.hpp>
#include <heml/world/model.hpp>
#include <heml/world/node_masses.hpp>
#include <limits>
#include <memory>
#include <utility>

namespace heml {

/// The values of a body's objective, apart from contact's: loads, the step under way, and results at the last
/// positions.
class BodyObjectiveMemory {
 protected:
  double time_ = 0, duration_ = 0, d_ = 0, regularisation_ = 0;
  Vec3 gravity_ = Vec3::Zero(), full_gravity_ = Vec3::Zero();
  Vector x_bar_;
  double noise_ = 0, acceleration_round_off_ = 0;
  int inverted_at_start_ = 0;
  int steps_in_double_ = 0;  ///< steps for which elements are evaluated in double; 0: in Real
  Vector forces_, external_;
  // Solvers ask again where they have just been; both are empty where time, loads or memory have changed since.
  Vector forces_at_;
  std::deque<std::pair<Vector, double>> values_;  ///< positions and Φ there, of the last few
  bool is_defined_ = true, flow_lags_ = false;
  Vector linearisation_point_;  ///< 3 #V, where pressure that follows the surface is part of K, else empty
};

template <class Real>
class BodyObjective final : public LoadDependentObjective, private BodyObjectiveMemory {
 public:
  struct Snapshot {
    BodyObjectiveMemory objective;
    ContactPotentialMemory contact;
  };

  /// All must outlive this.
  BodyObjective(ElasticBody<Real>& body, const Shared<Model<Real>>& model, const Shared<NodeMasses<Real>>& masses,
                const FreeNodes& free, const std::vector<GraspSpring<Real>>& grasps, Contacts& contacts,
                ThreadTeam& team);

  /// Loads as at time t, s. gravity: m/s².
  void set_time(double time, const Vec3& gravity);
  /// Velocities are (x − x_bar)/d, for what is damped; d = 0: no velocity.
  void set_velocity(double d, const Vector& x_bar);
  /// Adds a · mass to the stiffness, not to the residual, a in 1/s²: holds what nothing else does while it is solved.
  void set_regularisation(double a) { regularisation_ = a; }

  /// Whether plastic flow comes after the step alone, and not in all that is evaluated in it
  /// (elastic/plastic_flow.hpp).
  void set_flow_lags(bool lags);
  /// ElasticBody::begin_step(), for the memory of the body alone.
  void begin_memory_step(double h) {
    body_.begin_step(static_cast<Real>(h));
    clear_cache();
  }
  /// A step begins at x, at a time, s; it has ended at x.
  void begin_step(const Vector& x, double time);
  void end_step(const Vector& x);
  /// Moves tools alone to where they are at a time, s.
  void move_tools(double time);
  void reset_contact() { contact_.reset(); }
  /// ContactPotential::expect().
  void expect_contact(const Vector& x) {
    contact_.expect(x);
    clear_cache();
  }
  /// From now on tissue passes tissue.
  void disable_self_contact() { contact_.disable_self_contact(); }
  /// Adds what contact does at x, where the last step has ended, N.
  void add_contact(const Vector& x, Vector& f) { contact_.add_forces(x, f); }

  // Static worlds: the load is the fraction of a duration, s; start: the state at load 0.
  void begin_static(double duration, const Vec3& gravity, const Vector& start);
  void set_load(double fraction) override;
  void apply_constraints(double fraction, Vector& x) const override;
  double relative_residual(const Vector& r) const override;
  bool is_at_round_off(const Vector& r) const override;
  bool is_admissible(const Vector& x) const override;
  void accept(const Vector& x) override;
  bool update_lagged(const Vector& x) override;

  bool residual(const Vector& x, Vector& r) override;
  std::optional<double> value(const Vector& x) override;
  double value_round_off() const override { return noise_ * round_off_scale(); }
  bool refine_precision() override;
  bool inverts_elements(const Vector& from, const Vector& to) const override;
  void linearise(const Vector& x, Projection projection = Projection::none) override;
  void step_taken(double part) override { contact_.step_taken(part); }
  void product(const Vector& dx, Vector& out) override;
  bool is_symmetric() const override { return linearisation_point_.size() == 0; }
  void add_stiffness(BlockMatrix& matrix) override;
  void add_coupled_pairs(std::vector<std::array<int, 2>>& pairs) const override {
    if (!contact_.empty()) contact_.add_coupled_pairs(pairs);
  }
  bool assemble_single_precision(BsrMatrix& rows) override;
  void add_rank_one_terms(std::vector<RankOneTerm>& terms) const override {
    if (!contact_.empty()) contact_.add_rank_one_terms(terms);
  }

  /// Force of all loads and gravity together at the last residual(), as a part of their sizes' sum: 0 where they
  /// balance.
  double relative_net_load() const;
  /// Forces from all sides but supports at the last residual(), 3 #V, N.
  const Vector& forces() const { return forces_; }
  /// ‖M⁻¹r‖_∞, m/s².
  double max_acceleration(const Vector& r) const;
  /// Round-off of forces, as an acceleration, m/s²: the largest at any node, at rest.
  double acceleration_round_off() const { return acceleration_round_off_ * round_off_scale(); }
  /// Whether elements are evaluated in double although the body is in float.
  bool is_refined() const { return steps_in_double_ > 0; }
  /// To be called when the body has lost elements.
  void elements_changed();

  Snapshot snapshot() const { return {*this, contact_.memory()}; }
  void restore(const Snapshot& snapshot) {
    BodyObjectiveMemory::operator=(snapshot.objective);
    contact_.restore(snapshot.contact);
    make_double_body();
  }

 private:
  void make_double_body();
  double round_off_scale() const {
    return is_refined() ? std::numeric_limits<double>::epsilon() / std::numeric_limits<Real>::epsilon() : 1;
  }
  /// Calls use(body) with the body whose elements are evaluated, in float or double.
  template <class Use>
  auto with_body(const Use& use) const {
    return is_refined() ? use(*double_body_) : use(body_);
  }
  const Real* as_real(const Vector& x, std::vector<Real>& scratch) const;
  void find_noise();
  void clear_cache();
  void find_forces(const Vector& x);
  double find_value(const Vector& x);
  double elastic_potential(const Vector& x);
  void add_external(const Real* x, const Vector& x_double);
  template <class Matrix>
  void add_diagonal(Matrix& matrix) const;
  template <class Matrix>
  void add_contact_stiffness(Matrix& matrix) const;
  template <class Visit>
  void each_pressed_face(const Vector& x, const Visit& visit) const;
  template <class Visit>
  void each_pressed_point(const Vector& x, const Visit& visit) const;
  int count_inverted(const Vector& x) const;

  ElasticBody<Real>& body_;
  std::unique_ptr<ElasticBody<double>> double_body_;  ///< null until refined
  const Shared<Model<Real>>& model_;
  const Shared<NodeMasses<Real>>& masses_;
  const FreeNodes& free_;
  const std::vector<GraspSpring<Real>>& grasps_;
  ThreadTeam& team_;
  ContactPotential contact_;
  /// Elastic energies of the last positions, which loads do not change: a step starts where the one before has ended.
  /// Results of what body_ is, so no part of a snapshot.
  struct ElasticEnergy {
    std::vector<Real> x;
    double activation, value;
  };
  std::deque<ElasticEnergy> elastic_;
  std::vector<Real> x_, dx_, f_, v_;  ///< scratch
  Vector change_;                     ///< scratch: of forces, N
};

}  // namespace heml
