#pragma once
// What the engine publishes for eyes: a picture of the body at one tick. Immutable once published.
#include <heml/world/world.hpp>
#include <string>
#include <vector>

namespace heml {

/// The part of the body that is drawn; fixed while the topology is. Indices are into Skin::nodes.
struct Skin {
  std::vector<int> nodes;           ///< #S: mesh-file numbers of the surface's nodes
  std::vector<Vec3f> rest;          ///< #S×3, m
  std::vector<Triangle> triangles;  ///< #F×3, outward
  std::vector<int> regions;         ///< #F: region of the element behind each triangle
  std::vector<int> held;            ///< indices of nodes with a boundary condition
};

/// How well the engine keeps up with the wall clock.
struct Pace {
  double rate = 0;          ///< Hz, ticks asked for per simulated second
  double slowdown = 1;      ///< wall seconds per simulated second over the last second; 1: real time
  long missed = 0;          ///< ticks that ended after their deadline, since start
  double p50 = 0, p99 = 0;  ///< s a tick, over the last 1000 ticks
  bool keeping_up = true;   ///< false while simulated time is slower than asked
};

struct Frame {
  long tick = 0;
  double time = 0;               ///< s, simulated
  std::vector<Vec3f> positions;  ///< #S×3, m, in the order of Skin::nodes
  Field field = Field::none;
  std::vector<float> values;     ///< #S in the field's unit; empty for Field::none
  std::vector<float> stretches;  ///< #S, largest principal stretch; empty unless asked for
  Energies energies;
  double min_J = 1, max_J = 1;
  ToolState tool;
  Pace pace;
  int substeps = 1;
  double stable_step = 0;  ///< s
  bool paused = false;
  std::string halted;  ///< why the world will not step on; empty while it does
};

}  // namespace heml
