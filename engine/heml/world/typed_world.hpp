#pragma once
// A world of one scalar type. tick() lists the phases of a tick; each phase is a type of its own, named in the members.
#include <heml/world/action_history.hpp>
#include <heml/world/command_executor.hpp>
#include <heml/world/explicit_stepper.hpp>
#include <heml/world/implicit_stepper.hpp>
#include <heml/world/mesh_editor.hpp>
#include <heml/world/method_choice.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/simulation.hpp>
#include <heml/world/static_stepper.hpp>
#include <heml/world/step_rescue.hpp>
#include <heml/world/world.hpp>
#include <heml/world/world_queries.hpp>

namespace heml {

struct MeshSize {
  std::size_t nodes, tets;
  bool operator==(const MeshSize&) const = default;
};

template <class Real>
struct TypedSnapshot final : WorldSnapshot {
  MeshSize at_start;
  Shared<WorldSetup> opened;
  SimulationSnapshot<Real> simulation;
  EditHistory<Real> edits;
  ActionLists<Real> actions;

  long ticks() const override { return simulation.values.ticks; }
  double time() const override { return simulation.values.state.time; }
  std::size_t bytes() const override { return simulation.bytes(); }
};

template <class Real>
class TypedWorld final : public World {
 public:
  explicit TypedWorld(WorldSetup setup);
  explicit TypedWorld(const TypedSnapshot<Real>& snapshot);

  Status apply(const Command& command) override;
  void tick() override;
  void advance_within_tick(double time) override;
  void load_to(double fraction) override;
  void interrupt() override { s_.interrupted = true; }
  std::shared_ptr<const WorldSnapshot> snapshot() override;
  Status restore(const WorldSnapshot& snapshot) override;
  bool copy_motion_from(const World& leader) override;
  std::shared_ptr<PreconditionerBuild> preconditioner_build() override { return implicit_.preconditioner_build(); }
  void limit_threads(int threads) override { s_.team.limit(threads); }

  bool unfinished() const override { return s_.unfinished; }
  const std::optional<StopReason>& halt() const override { return s_.halt; }
  const Recovery* recovery() const override { return s_.recovery && s_.recovery->last ? &*s_.recovery->last : nullptr; }
  long recoveries() const override { return s_.recovery ? s_.recovery->count : 0; }
  long ticks() const override { return s_.ticks; }
  double elapsed() const override { return s_.elapsed(); }
  double time() const override { return s_.state.time; }
  long steps() const override { return s_.steps; }
  int substeps() const override { return s_.substeps; }
  double stable_step() const override { return s_.limit.stable; }
  SolverStats solver_stats() const override;
  std::vector<Vec3> positions() const override { return s_.positions(); }
  std::vector<Vec3> velocities() const override { return s_.in_file_order(s_.state.v); }
  void write_vectors(NodeVector which, std::span<double> out) const override { queries_.write_vectors(which, out); }
  void write_positions(std::span<const int> nodes, double ahead, std::vector<Vec3f>& out) const override {
    queries_.write_positions(nodes, ahead, out);
  }
  void write_field(Field field, std::span<const int> nodes, std::vector<float>& out) override {
    queries_.write_field(field, nodes, out);
  }
  Energies energies() override { return s_.energies(); }
  std::vector<double> volume_ratios() override { return queries_.volume_ratios(); }
  std::vector<double> point_volume_ratios() override { return queries_.point_volume_ratios(); }
  std::vector<Mat3> stresses() override { return queries_.stresses(); }
  std::optional<ErrorEstimate> error_estimate() override { return queries_.error_estimate(); }
  std::vector<Vec3> reactions() override { return queries_.reactions(); }
  std::vector<ToolState> tools() const override { return queries_.tools(); }
  std::uint64_t state_hash() const override { return queries_.state_hash(); }
  std::vector<std::uint16_t> node_hashes() const override { return queries_.node_hashes(); }
  std::shared_ptr<const Topology> topology() const override { return s_.topology; }
  const std::vector<EditReport>& edits() const override { return s_.edits; }
  ActionList actions() const override;
  const WorldSetup& setup() const override { return *s_.setup; }
  int threads() const override { return s_.team.limit(); }
  double worker_seconds() const override { return s_.team.worker_seconds(); }
  WorldFacts facts() override;

 private:
  void start();
  void reopen();
  Status carry_out(const Command& command);
  Status step_history(int by);
  std::shared_ptr<const Moment<Real>> moment();
  void set_initial_state();
  void advance(double until);
  void handle(const std::optional<StopReason>& failure);
  void handle_implicit(const std::optional<StopReason>& failure, double until);

  Simulation<Real> s_;
  const Shared<WorldSetup> opened_;  ///< as it was made
  const MeshSize at_start_;          ///< with the mesh itself it tells whose snapshots fit
  ExplicitStepper<Real> explicit_{s_};
  ImplicitStepper<Real> implicit_{s_};
  StepRescue<Real> rescue_{s_, explicit_, implicit_};
  StaticStepper<Real> static_{s_};
  MethodChoice<Real> method_{s_};
  RecoveryController<Real> recovery_{s_, method_};
  MeshEditor<Real> editor_{s_, recovery_};
  ActionHistory<Real> actions_;
  CommandExecutor<Real> commands_{s_, method_, implicit_, recovery_, editor_};
  WorldQueries<Real> queries_{s_};
};

}  // namespace heml
