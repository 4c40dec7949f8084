#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/scenario/scene.hpp>
#include <map>
#include <mutex>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

double mean_edge(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) {
    const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(t[c])]; };
    sum += (X(1) - X(0)).norm();
  }
  return sum / static_cast<double>(mesh.tets.size());
}

/// Reads each scene once, so that its warnings appear once.
WorldSetup as_in_file(const std::string& scene) {
  static std::mutex door;
  static std::map<std::string, WorldSetup> known;
  const std::lock_guard lock(door);
  const auto found = known.find(scene);
  if (found != known.end()) return found->second;
  return known[scene] = load_setup(read_scene(assets_folder() / "scenes" / "extreme" / (scene + ".json")));
}

}  // namespace

std::string to_text(const CaseVariant& variant) {
  return fmt::format("{}{}{} {}", variant.law, variant.integrator ? " " : "",
                     variant.integrator ? integrator_name(*variant.integrator) : "",
                     variant.single ? "float" : "double");
}

const char* verdict_name(Verdict verdict) {
  constexpr const char* names[] = {"stable", "recovered", "inverted", "diverged", "wrong-but-finite", "no solution"};
  return names[static_cast<std::size_t>(verdict)];
}

Verdict judge(const Outcome& outcome, double limit) {
  const bool is_proven = !outcome.proof.empty();
  if (!outcome.stopped.empty() || !std::isfinite(outcome.value))
    return is_proven ? Verdict::unsolvable : Verdict::diverged;
  if (outcome.inverted > 0) return is_proven ? Verdict::unsolvable : Verdict::inverted;
  if (!outcome.broken.empty() || outcome.value > limit) return Verdict::wrong;
  return outcome.recoveries > 0 ? Verdict::recovered : Verdict::stable;
}

bool is_sound(Verdict verdict) {
  return verdict == Verdict::stable || verdict == Verdict::recovered || verdict == Verdict::unsolvable;
}

Outcome worse(const Outcome& a, const Outcome& b) {
  const auto unproven = [](const Outcome& o) {
    return (!o.stopped.empty() || o.inverted > 0 || !std::isfinite(o.value)) && o.proof.empty();
  };
  Outcome outcome = a.value >= b.value || std::isnan(a.value) ? a : b;
  outcome.inverted = std::max(a.inverted, b.inverted);
  outcome.recoveries = std::max(a.recoveries, b.recoveries);
  outcome.stopped = a.stopped.empty() ? b.stopped : a.stopped;
  outcome.broken = a.broken.empty() ? b.broken : a.broken;
  outcome.note = b.note.empty() ? a.note : b.note;
  outcome.proof = unproven(a) || unproven(b) ? "" : a.proof.empty() ? b.proof : a.proof;
  return outcome;
}

WorldSetup Trial::setup(const std::string& scene) const {
  WorldSetup setup = as_in_file(scene);
  const double edge = mean_edge(setup.mesh);
  for (RegionMaterial& entry : setup.materials) {
    if (entry.material.law == variant.law) continue;
    const SmallStrainModuli ground = small_strain_moduli(entry.material);
    const double density = entry.material.density;
    entry.material = material_of(variant.law, ground.shear, ground.bulk, edge);
    entry.material.density = density;
  }
  if (variant.integrator) setup.solver.integrator = *variant.integrator;
  setup.solver.single_precision = variant.single;
  setup.solver.threads = 1;  // cases run in parallel; results do not depend on threads
  return setup;
}

std::unique_ptr<World> Trial::world(WorldSetup setup) const {
  if (world_fault) world_fault(setup);
  return make_world(std::move(setup));
}

}  // namespace heml::stability
