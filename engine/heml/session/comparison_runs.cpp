#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/session/comparison_runs.hpp>
#include <heml/session/surface_mesh.hpp>

namespace heml {
namespace {

bool concerns(const Command& command, const Variant& variant) {
  if (std::holds_alternative<SetMaterial>(command) || std::holds_alternative<SetActiveStress>(command))
    return !variant.has_law;
  if (std::holds_alternative<SetIntegrator>(command)) return !variant.has_integrator;
  // Chosen from timings of the session's own world.
  return !std::holds_alternative<AdoptPreconditioner>(command) && !std::holds_alternative<SetStepCost>(command);
}

/// What a command is to a variant: one of another law gives regions none of the body's.
Command for_variant(Command command, const Variant& variant) {
  if (auto* tag = std::get_if<TagRegion>(&command); tag && variant.has_law) tag->material.reset();
  return command;
}

/// Distance between the nodes of two frames; none where the frames have different nodes.
std::optional<Distance> distance_between(const Frame& a, const Frame& b) {
  if (a.surface_mesh->nodes != b.surface_mesh->nodes || a.positions.empty()) return std::nullopt;
  Distance distance;
  for (std::size_t n = 0; n < a.positions.size(); ++n) {
    const double separation = static_cast<double>((a.positions[n] - b.positions[n]).norm());
    distance.mean += separation / static_cast<double>(a.positions.size());
    distance.max = std::max(distance.max, separation);
  }
  return distance;
}

}  // namespace

ComparisonRuns::ComparisonRuns(const WorldSetup& setup, const std::vector<std::string>& words)
    : team_(static_cast<int>(
          std::min<std::size_t>(words.size() + 1, std::max(1u, std::thread::hardware_concurrency())))) {
  if (words.size() > max)
    throw InputError("beside", fmt::format("{}", fmt::join(words, ",")), fmt::format("is more than {} variants", max),
                     "leave some out");
  for (const std::string& word : words) {
    Variant variant = variant_of(setup, word);
    variant.setup.solver.threads = 1;  // runs tick in parallel; the number of threads changes no bit
    auto world = make_world(std::move(variant.setup));
    comparison_runs_.push_back({std::move(variant), std::move(world), nullptr, nullptr, {}});
  }
}

void ComparisonRuns::apply(const Command& command) {
  for (ComparisonRun& run : comparison_runs_)
    if (concerns(command, run.variant))
      if (const Status status = run.world->apply(for_variant(command, run.variant)); !status.ok())
        warn("{}: {}", run.variant.name, status.message());
}

double ComparisonRuns::tick(World& world) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  const auto all_began = Clock::now();
  double own = 0;
  team_.parallel_for(comparison_runs_.size() + 1, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      World& one = k == 0 ? world : *comparison_runs_[k - 1].world;
      if (one.halt()) continue;
      const auto began = Clock::now();
      one.tick();
      if (k == 0) own = seconds_since(began);
    }
  });
  return seconds_since(all_began) - own;
}

void ComparisonRuns::interrupt() {
  for (ComparisonRun& run : comparison_runs_) run.world->interrupt();
}

void ComparisonRuns::fill(const World& world, Frame& frame, double ahead, const SkinAttachment& skin) {
  frame.variant = variant_name(world.setup());
  frame.comparisons.resize(comparison_runs_.size());
  for (std::size_t k = 0; k < comparison_runs_.size(); ++k) {
    ComparisonRun& run = comparison_runs_[k];
    Frame& comparisons = frame.comparisons[k];
    run.surface_mesh = make_surface_mesh(*run.world, std::move(run.surface_mesh), frame.surface_mesh->hidden);
    fill_frame(*run.world, run.surface_mesh, frame.field, ahead, comparisons);
    if (frame.solid)
      fill_solid(*run.world, ahead, run.solid, comparisons);
    else
      clear_solid(comparisons);
    if (!run.skin.exists()) run.skin = skin.for_another_world();
    run.skin.attach(*run.world, comparisons);
    comparisons.variant = run.variant.name;
    comparisons.distance = distance_between(frame, comparisons);
  }
}

}  // namespace heml
