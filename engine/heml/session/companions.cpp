#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/session/companions.hpp>
#include <heml/session/skin.hpp>

namespace heml {
namespace {

bool concerns(const Command& command, const Variant& variant) {
  if (std::holds_alternative<SetMaterial>(command)) return !variant.has_law;
  if (std::holds_alternative<SetIntegrator>(command)) return !variant.has_integrator;
  // What the clock chose for the session's own world.
  return !std::holds_alternative<TakeFactor>(command) && !std::holds_alternative<SetStepCost>(command);
}

/// How far the nodes of two frames are from each other; none where they do not have the same.
std::optional<Distance> distance_between(const Frame& a, const Frame& b) {
  if (a.skin->nodes != b.skin->nodes || a.positions.empty()) return std::nullopt;
  Distance distance;
  for (std::size_t n = 0; n < a.positions.size(); ++n) {
    const double apart = static_cast<double>((a.positions[n] - b.positions[n]).norm());
    distance.mean += apart / static_cast<double>(a.positions.size());
    distance.most = std::max(distance.most, apart);
  }
  return distance;
}

}  // namespace

Companions::Companions(const WorldSetup& setup, const std::vector<std::string>& words)
    : team_(static_cast<int>(
          std::min<std::size_t>(words.size() + 1, std::max(1u, std::thread::hardware_concurrency())))) {
  if (words.size() > most)
    throw InputError("beside", fmt::format("{}", fmt::join(words, ",")), fmt::format("is more than {} ways", most),
                     "leave some out");
  for (const std::string& word : words) {
    Variant variant = variant_of(setup, word);
    variant.setup.solver.threads = 1;  // they are run side by side, and threads change no bit
    auto world = make_world(std::move(variant.setup));
    companions_.push_back({std::move(variant), std::move(world), nullptr});
  }
}

void Companions::apply(const Command& command) {
  for (Companion& companion : companions_)
    if (concerns(command, companion.variant))
      if (const auto problem = companion.world->apply(command)) warn("{}: {}", companion.variant.name, *problem);
}

double Companions::tick(World& world) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  const auto all_began = Clock::now();
  double own = 0;
  team_.for_ranges(companions_.size() + 1, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      World& one = k == 0 ? world : *companions_[k - 1].world;
      if (one.halt()) continue;
      const auto began = Clock::now();
      one.tick();
      if (k == 0) own = seconds_since(began);
    }
  });
  return seconds_since(all_began) - own;
}

void Companions::interrupt() {
  for (Companion& companion : companions_) companion.world->interrupt();
}

void Companions::fill(const World& world, Frame& frame, double ahead) {
  frame.way = way_of(world.setup());
  frame.beside.resize(companions_.size());
  for (std::size_t k = 0; k < companions_.size(); ++k) {
    Companion& companion = companions_[k];
    Frame& beside = frame.beside[k];
    companion.skin = skin_of(*companion.world, std::move(companion.skin));
    fill_frame(*companion.world, companion.skin, frame.field, ahead, beside);
    beside.way = companion.variant.name;
    beside.apart = distance_between(frame, beside);
  }
}

}  // namespace heml
