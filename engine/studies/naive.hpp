#pragma once
// The textbook loop: for every tetrahedron F = Ds Dm⁻¹, P = F S, and −V P Dm⁻ᵀ added to its nodes, one after the other,
// in double. Stresses are written out from textbooks, independently of the engine: a baseline for its speed and a check
// of its forces. A law without a loop takes its stress from a MaterialPoint, which shares its formula with the engine
// but not the tension form, and is slower than a written-out loop.
#include <heml/materials/point.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <memory>
#include <studies/naive_loops.hpp>
#include <vector>

namespace heml {

class NaiveForces {
 public:
  /// mesh: positive volumes. material: one law for all elements, without viscosity, plasticity or continuation. loop:
  /// that of the law; nullptr: uses a MaterialPoint.
  NaiveForces(const TetMesh& mesh, const Material& material) : NaiveForces(mesh, material, naive_loop(material.law)) {}
  NaiveForces(const TetMesh& mesh, const Material& material, NaiveLoop loop);
  NaiveForces(const NaiveForces&) = delete;
  NaiveForces& operator=(const NaiveForces&) = delete;

  /// Forces at positions x (3 #V, metres) into f (3 #V, overwritten), N. One thread.
  void operator()(const double* x, double* f) const;

 private:
  std::vector<int> corners_, ends_;
  std::vector<double> Dm_inverse_, volume_, length_, parameters_;
  NaiveBody body_{};
  NaiveLoop loop_;
  std::unique_ptr<MaterialPoint> point_;  ///< used if there is no loop
};

}  // namespace heml
