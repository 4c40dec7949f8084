#pragma once
// The blade or the electrode of a scripted or recorded stroke.
#include <app/render/stroke_drawing.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <span>

namespace heml::panel {

/// The blade or the electrode where the last sweep up to a tick ended; none if that was more than 0.1 s before. events:
/// ascending in tick. rate: ticks per second.
render::StrokeDrawing scripted_stroke(std::span<const Event> events, long tick, double rate);

/// The blade at the end of a sweep, which has two or more positions.
render::Blade blade_after(const Sweep& sweep);

}  // namespace heml::panel
