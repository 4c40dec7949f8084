#pragma once
// A world of one scalar type: the step, and everything people ask of it.
#include <atomic>
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/implicit_stage.hpp>
#include <heml/dynamics/preconditioner_build.hpp>
#include <heml/dynamics/state.hpp>
#include <heml/elastic/body.hpp>
#include <heml/tools/contact_impulses.hpp>
#include <heml/tools/grasp.hpp>
#include <heml/tools/pin.hpp>
#include <heml/tools/tearing.hpp>
#include <heml/world/facts.hpp>
#include <heml/world/implicit_state.hpp>
#include <heml/world/model.hpp>
#include <heml/world/recovery_cause.hpp>
#include <heml/world/recovery_state.hpp>
#include <heml/world/world.hpp>

namespace heml {

inline constexpr double min_step = 1e-9;  ///< s; below it a body is not soft tissue but a mistake

template <class Real>
class TypedWorld final : public World {
 public:
  explicit TypedWorld(WorldSetup setup);

  std::optional<std::string> apply(const Command& command) override;
  void tick() override;
  void advance_within_tick(double time) override;
  void load_to(double fraction) override;
  void interrupt() override { interrupted_ = true; }
  bool unfinished() const override { return unfinished_; }
  const std::optional<StopReason>& halt() const override { return halt_; }
  const Recovery* recovery() const override { return recovery_ && recovery_->last ? &*recovery_->last : nullptr; }
  long recoveries() const override { return recovery_ ? recovery_->count : 0; }
  long ticks() const override { return ticks_; }
  double time() const override { return state_.time; }
  long steps() const override { return steps_; }
  int substeps() const override { return substeps_; }
  double stable_step() const override { return stable_step_; }
  SolverStats solver_stats() const override;
  std::vector<Vec3> positions() const override { return in_file_order(state_.x); }
  std::vector<Vec3> velocities() const override { return in_file_order(state_.v); }
  void write_positions(std::span<const int> nodes, double ahead, std::vector<Vec3f>& out) const override;
  void write_field(Field field, std::span<const int> nodes, std::vector<float>& out) override;
  Energies energies() override;
  std::vector<double> volume_ratios() override;
  std::vector<Mat3> stresses() override;
  std::optional<ErrorEstimate> error_estimate() override;
  std::vector<Vec3> reactions() override;
  ToolState tool() const override;
  std::vector<PinState> pins() const override;
  std::vector<TableState> tables() const override;
  ProbeState probe() const override;
  std::vector<SutureState> sutures() const override;
  std::optional<SelfContactState> self_contact() const override;
  bool copy_motion_from(const World& leader) override;
  std::uint64_t state_hash() const override;
  std::vector<std::uint16_t> node_hashes() const override;
  std::shared_ptr<const Topology> topology() const override { return topology_; }
  const std::vector<EditReport>& edits() const override { return edits_; }
  std::shared_ptr<PreconditionerBuild> preconditioner_build() override;
  WorldFacts facts() override;
  const WorldSetup& setup() const override { return setup_; }
  void limit_threads(int threads) override { team_.limit(threads); }
  int threads() const override { return team_.limit(); }
  double worker_seconds() const override { return team_.worker_seconds(); }

 private:
  static constexpr bool single_ = sizeof(Real) == sizeof(float);

  // typed_world.cpp: stepping
  void advance(double until);
  void advance_explicit(double until);
  double choose_step(double until);
  void step(Real h, double time_after);
  template <class Method>
  void step_with(Real h, double time_after);
  void move_constrained();
  bool evaluate_forces();
  int steps_until_supports_strain() const;
  void find_stable_step();
  void update_stable_step();
  std::string why_no_step() const;
  StopReason out_of_range(const std::vector<Real>& x, double time) const;
  void restore_last_valid(StopReason::Cause cause);
  void stop(const StopReason& halt);
  void start();
  void update_masses();
  Vec3 gravity_now() const;

  // method_choice.cpp
  Integrator choose_method();
  void reconsider_method();
  double explicit_load() const;
  double explicit_share() const;
  double step_cost() const;
  std::optional<std::string> execute(const SetStepCost& command);
  double lowest_frequency();
  MethodFacts method_facts();

  // implicit_steps.cpp, static_load.cpp: what solves
  void advance_implicit(double until);
  bool implicit_step(double h, double time_after);
  bool solve_stage(const Stage& stage, double h, double time, Vector& x, Vector& v);
  NewtonResult minimise_stage(Vector& x);
  int probe_substeps(double h) const;
  Vector stage_start(const Stage& stage, double time, const Vector& x);
  StoppingCriterion stage_criterion();
  bool is_balanced_enough(const Stage& stage, const Vector& r);
  void halt_unsolved(const StopReason& halt);
  std::string why_unbalanced() const;
  StopReason why_not_beyond(const StaticSolve& equilibrium) const;
  int first_flat(const std::vector<Real>& x) const;
  ImplicitState<Real>& implicit();
  void set_state(const Vector& x, const Vector& v, double time);
  static Vector as_vector(const std::vector<Real>& values);

  // recovery_steps.cpp: bringing a body back
  bool recovering() const { return recovery_ && recovery_->surrogate; }
  bool monitors() const { return recovery_ && !recovery_->surrogate && !halt_; }
  ElasticBody<Real>& acting_body() { return recovering() ? recovery_->surrogate->body : body_; }
  void start_monitoring();
  double fastest_waves() const;
  double shear_waves() const;
  void monitor();
  bool is_step_hopeless() const;
  bool can_recover(const StopReason& halt);
  void begin_recovery(const StateCheck& seen);
  FailureDiagnosis diagnose(const StateCheck& seen) const;
  void install_surrogate();
  void set_apart();
  void recover(double until);
  void step_surrogate(double until);
  void unfold(double part);
  void end_recovery();

  // budget.cpp
  int stage_iterations() const;
  void limit_energy(double h, double time, Vector& x, Vector& v);
  std::optional<std::string> execute(const SetBudget& command);

  // world_commands.cpp: what people do
  std::optional<std::string> execute(const Grasp& command);
  std::optional<std::string> execute(const MoveTool& command);
  std::optional<std::string> execute(const Release& command);
  std::optional<std::string> execute(const PinTissue& command);
  std::optional<std::string> execute(const Unpin& command);
  std::optional<std::string> execute(const SetMaterial& command);
  std::optional<std::string> execute(const SetDamping& command);
  std::optional<std::string> execute(const SetGravity& command);
  std::optional<std::string> execute(const SetIntegrator& command);
  std::optional<std::string> execute(const Reset& command);
  std::vector<int> surface_with(int node) const;
  void update_constraints();

  // contact_commands.cpp: tables, the probe, sutures
  std::optional<std::string> execute(const SetTables& command);
  std::optional<std::string> execute(const MoveProbe& command);
  std::optional<std::string> execute(const WithdrawProbe& command);
  std::optional<std::string> execute(const SutureTissue& command);
  std::optional<std::string> execute(const CutSutures& command);
  void update_contact_surfaces();
  void update_self_contact();
  void update_contact_boundary();
  std::vector<ConstrainedNode> constrained_nodes() const;

  // world_edits.cpp: other elements
  /// What an edit may be taken back to.
  struct Saved {
    TetMesh mesh;
    std::vector<Boundary> boundary;
    std::vector<Load> loads;
    Model<Real> model;
    std::shared_ptr<const Topology> topology;
    BodyMemory<Real> body;
    std::vector<PinnedPatch> pins;
    std::vector<Suture> sutures;
    std::vector<GraspSpring<Real>> grasps;
    long grasps_taken;
    // Of the moment itself:
    long changes;
    State<Real> state;
    double stable_step;
    int steps_since_bound, bound_interval;
    std::optional<double> lowest_frequency;
    std::optional<ImplicitMemory> implicit;
  };
  std::optional<std::string> execute(const RemoveElements& command);
  std::optional<std::string> execute(const CutTissue& command);
  std::optional<std::string> execute(const Undo& command);
  void tear();
  EditReport begin_report();
  void end_report(EditReport& report);
  std::optional<std::string> execute(const AdoptPreconditioner& command);
  void carry_out(const MeshEdit& edit);
  void rebuild_after_edit();
  void save();
  void restore(const Saved& saved);
  void restore_grasp(const Saved& saved);
  void restore_moment(const Saved& saved);
  void undo_edits();

  // facts.cpp: what it runs
  StepFacts step_facts();
  std::optional<SolverFacts> solver_facts();
  std::vector<MemoryFacts> memory_facts() const;
  std::size_t bytes_to_undo() const;

  // world_queries.cpp: what people ask
  std::vector<Vec3> in_file_order(const std::vector<Real>& values) const;
  std::uint64_t node_hash(std::size_t file_node) const;
  std::vector<double> element_values(Field field);
  std::optional<ErrorEstimate> estimate();
  std::vector<Vec3> inner_positions() const;

  WorldSetup setup_;
  Model<Real> model_;
  std::shared_ptr<const Topology> topology_;
  std::vector<EditReport> edits_;
  std::shared_ptr<const Saved> whole_;               ///< before the first edit; none: there was none
  std::vector<std::shared_ptr<const Saved>> saved_;  ///< before each of the last edits
  long changes_ = 0;  ///< steps, loads and commands that are no edits: as many as before, nothing else has happened
  bool is_known_ = false;    ///< whether forces and stable step are those of the state: an undo has brought them back
  std::vector<int> stroke_;  ///< nodes in the last cut, mesh-file order
  bool in_stroke_ = false;   ///< whether it was saved before it
  std::optional<long> missed_;      ///< tick of the last stroke, where it has parted nothing
  double snap_ = 0;                 ///< m, of cuts; 0: nothing was cut yet
  std::optional<Tearing> tearing_;  ///< none unless the scene asks for it
  ElasticBody<Real> body_;
  ThreadTeam team_;
  std::vector<GraspSpring<Real>> grasps_;  ///< none or one: an empty list costs nothing
  long grasps_taken_ = 0;                  ///< so far: tells one from another
  std::vector<PinnedPatch> pins_;          ///< in the order they were set
  Contacts contacts_;                      ///< nothing, in most worlds
  ContactImpulses<Real> impulses_;

  bool remembers_ = false;                  ///< whether a material has viscosity, relaxation or plasticity
  std::vector<Real> mass_;                  ///< #V, kg
  std::vector<Real> inverse_mass_;          ///< #V, 1/kg; 0 for held nodes and nodes of no element
  std::vector<Real> inverse_mass_per_dof_;  ///< 3 #V: the same of each coordinate
  State<Real> state_, last_valid_;

  Real rest_frequency_ = 0;                      ///< 1/s, bound of the highest at rest: scales the tools
  double stable_step_ = 0, limit_at_start_ = 0;  ///< s
  int steps_since_bound_ = 0, bound_interval_ = 0;
  long ticks_ = 0, origin_tick_ = 0, steps_ = 0;
  int substeps_ = 0;
  std::optional<StopReason> halt_;
  std::atomic<bool> interrupted_{false};
  bool unfinished_ = false;
  std::unique_ptr<ImplicitState<Real>> implicit_;              ///< none until an implicit or static method needs it
  std::shared_ptr<PreconditionerBuild> preconditioner_build_;  ///< given out last, if it may still serve
  long preconditioner_version_ = 0;                            ///< of the topology it is of
  std::unique_ptr<RecoveryState<Real>> recovery_;              ///< none unless the scene asks for it
  std::vector<Real> undefined_at_;  ///< 3 #V, where the last stage that came to nothing was to begin; empty: defined
  SolverStats work_;
  Integrator method_ = Integrator::verlet;          ///< in use: what "auto" has chosen, else the scene's
  std::optional<double> told_step_cost_;            ///< s an element: an explicit step, one core (SetStepCost)
  std::optional<double> lowest_frequency_;          ///< 1/s, at rest; none until somebody asks
  std::vector<ElementState<Real>> element_states_;  ///< scratch of queries
};

}  // namespace heml
