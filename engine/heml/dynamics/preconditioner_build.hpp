#pragma once
// Job that builds the preconditioner of a body as it is at one moment. It owns copies of its input, so it can run on
// another thread while steps go on with the old preconditioner.
#include <atomic>
#include <heml/dynamics/smoothed_aggregation.hpp>
#include <memory>

namespace heml {

class PreconditionerBuild {
 public:
  /// As the constructor of SmoothedAggregation. a: of the steps that it will serve, 1/s². team must outlive the result;
  /// run() does not use it.
  PreconditionerBuild(FreeNodes free, TetMesh mesh, std::vector<double> modulus, Vector mass,
                      std::size_t max_direct_unknowns, double a, ThreadTeam& team)
      : free_(std::move(free)),
        mesh_(std::move(mesh)),
        modulus_(std::move(modulus)),
        mass_(std::move(mass)),
        max_direct_unknowns_(max_direct_unknowns),
        a_(a),
        team_(team) {}

  /// Builds the preconditioner. To be called once, on any thread.
  void run() {
    made_ = std::make_unique<SmoothedAggregation>(free_, mesh_, modulus_, mass_, max_direct_unknowns_, team_);
    is_definite_ = made_->set_inertia(a_);
    done_.store(true, std::memory_order_release);
  }
  bool done() const { return done_.load(std::memory_order_acquire); }

  // Only if done().
  std::unique_ptr<SmoothedAggregation> release() { return std::move(made_); }
  bool is_definite() const { return is_definite_; }
  double a() const { return a_; }

 private:
  FreeNodes free_;
  TetMesh mesh_;
  std::vector<double> modulus_;
  Vector mass_;
  std::size_t max_direct_unknowns_;
  double a_;
  ThreadTeam& team_;
  std::unique_ptr<SmoothedAggregation> made_;
  bool is_definite_ = false;
  std::atomic<bool> done_{false};
};

}  // namespace heml
