// Random strokes through cubes in 2 to 50 sweeps: how many leave a bridge where the tissue sways between the sweeps,
// and how many have another area than one sweep where it is still. By hand; prints the exceptions and two sums.
#include <fmt/format.h>

#include <engine/mesh/strokes.hpp>

int main() {
  using namespace heml::test;
  constexpr double tolerance = 0.02;  // of the area
  int strokes = 0, bridges = 0, areas = 0;
  for (const int cells : {4, 6, 8})
    for (unsigned seed = 20; seed <= 70; ++seed) {
      CutBody one = cube(cells, seed);
      const double area = cut_in_parts(one, random_stroke(seed), 1, still);
      for (const int parts : {2, 4, 10, 20, 50}) {
        ++strokes;
        CutBody swaying = cube(cells, seed), many = cube(cells, seed);
        cut_in_parts(swaying, random_stroke(seed), parts, sway);
        const double ratio = cut_in_parts(many, random_stroke(seed), parts, still) / area;
        const std::string which = fmt::format("{} cells across, seed {}, {} sweeps", cells, seed, parts);
        if (const int components = swaying.components(); components != 2) {
          ++bridges;
          fmt::print("{}: {} components of swaying tissue\n", which, components);
        }
        if (many.components() != one.components()) fmt::print("{}: other components than of one sweep\n", which);
        if (std::abs(ratio - 1) <= tolerance) continue;
        ++areas;
        fmt::print("{}: area {:+.1f} %\n", which, 100 * (ratio - 1));
      }
    }
  fmt::print("{} strokes: {} with a bridge, {} with another area\n", strokes, bridges, areas);
}
