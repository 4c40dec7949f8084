#pragma once
// What a world reports of its state, in mesh-file order. Results are documented in world.hpp.
#include <heml/world/facts.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class WorldQueries {
 public:
  explicit WorldQueries(Simulation<Real>& s) : s_(s) {}

  void write_vectors(NodeVector which, std::span<double> out) const;
  void write_positions(std::span<const int> nodes, double ahead, std::vector<Vec3f>& out) const;
  void write_field(Field field, std::span<const int> nodes, std::vector<float>& out);
  std::vector<double> volume_ratios();
  std::vector<double> point_volume_ratios();
  std::vector<Mat3> stresses();
  std::optional<ErrorEstimate> error_estimate();
  std::vector<Vec3> reactions() const;
  std::vector<ToolState> tools() const;
  std::uint64_t state_hash() const;
  std::vector<std::uint16_t> node_hashes() const;

  // facts.cpp
  StepFacts step_facts() const;
  std::optional<SolverFacts> solver_facts();
  /// history: bytes kept for undo; none: nothing was edited.
  std::vector<MemoryFacts> memory_facts(std::optional<std::size_t> history) const;

 private:
  std::uint64_t node_hash(std::size_t file_node) const;
  std::vector<double> element_values(Field field);
  std::optional<ErrorEstimate> estimate();
  std::vector<Vec3> inner_positions() const;
  Vec3 position(int node) const;
  GraspState state_of(const GraspSpring<Real>& grasp) const;
  PinState state_of(const PinnedPatch& pin) const;
  SutureState state_of(const Suture& suture, const ContactReport& report) const;

  Simulation<Real>& s_;
  std::vector<ElementState<Real>> element_states_;  ///< scratch
};

/// Bytes of the heap.
std::size_t bytes_of_mesh(const TetMesh& mesh);
template <class Real>
std::size_t bytes_of_model(const Model<Real>& model);

}  // namespace heml
