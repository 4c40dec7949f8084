#pragma once
// What is drawn of a stroke with scalpel, scissors or electrode.
#include <array>
#include <heml/math/types.hpp>
#include <optional>
#include <vector>

namespace heml::render {

struct Blade {
  std::array<Vec3f, 2> edge{Vec3f::Zero(), Vec3f::Zero()};  ///< m, ends of the cutting edge
  Vec3f heading = Vec3f::Zero();                            ///< of the last movement; zero: not moved yet
  float entry = 0;                                          ///< where it enters the skin, 0 at its upper end to 1
};

struct Scissors {
  Vec3f from = Vec3f::Zero(), to = Vec3f::Zero();  ///< m, ends of the jaw line on the skin; the tips are at `to`
  float opening = 0;                               ///< m, between the tips
  float closed = 0;                                ///< 0: open, 1: closed
};

struct Electrode {
  Vec3f tip = Vec3f::Zero();  ///< m, on the skin
};

struct StrokeDrawing {
  std::optional<Blade> blade;              ///< none: no stroke is under way
  std::vector<std::array<Vec3f, 2>> line;  ///< m, segments of the incision line on the skin
  std::optional<Scissors> scissors = std::nullopt;
  std::optional<Electrode> electrode = std::nullopt;
};

}  // namespace heml::render
