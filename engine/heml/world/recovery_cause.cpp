#include <fmt/format.h>

#include <cmath>
#include <heml/world/recovery_cause.hpp>

namespace heml {
namespace {

constexpr double sliver = 0.05;        // of least height over longest edge
constexpr double incompressible = 50;  // κ/μ, at ν = 0.49
constexpr double fast = 1;             // of the speed of shear waves
constexpr double least_shrink = 0.02;  // of lengths: less is borne by any law
constexpr double bearable = 1024;      // times shorter than at rest steps may be

std::string what(const FailureDiagnosis& s) {
  if (s.min_J > 0 && s.shortened > bearable)
    return fmt::format(
        "{} so stretched or crushed at t = {:.4g} s that steps would have to be {:.0f} times shorter than at rest",
        s.element < 0 ? "elements were" : fmt::format("element {} was", s.element), s.time, s.shortened);
  if (s.element < 0) return fmt::format("a node ran away at t = {:.4g} s", s.time);
  const std::string state = s.min_J > 0 ? "was pressed out of the range of its law" : "was flat or inside out";
  const std::string others = s.inverted > 1 ? fmt::format(", with {} in all inverted", s.inverted) : "";
  const std::string J = std::isfinite(s.min_J) ? fmt::format("J = {:.3g}", s.min_J) : "with nodes at no finite place";
  return fmt::format("element {} {} at t = {:.4g} s ({}{})", s.element, state, s.time, J, others);
}

/// The cause and what to do about it, from the surest to the most general.
std::string why(const FailureDiagnosis& s) {
  if (s.from_start) return "the body starts so: give it other initial positions if that is not meant";
  if (s.step > s.limit)
    return fmt::format(
        "the step of {:.3g} s is longer than the {:.3g} s that are stable now: take a shorter one, or none", s.step,
        s.limit);
  if (s.tool_speed > fast * s.wave_speed)
    return fmt::format(
        "the tool moves at {:.2g} m/s and waves in this tissue at {:.2g} m/s: move it more slowly, or grasp more "
        "tissue",
        s.tool_speed, s.wave_speed);
  if (s.burn_shrink > least_shrink)
    return fmt::format(
        "burnt tissue there has shrunk by {:.0f} % of its length and drags it along: burn less deeply or with less "
        "shrink, take a finer mesh there, or undo the burn",
        100 * s.burn_shrink);
  if (s.thinness < sliver)
    return fmt::format("it is a sliver ({:.2g} high for a longest edge of 1): improve the mesh there", s.thinness);
  if (s.stiffness_ratio > incompressible)
    return fmt::format(
        "its volume resists {:.0f} times as much as its shape: a lower Poisson's ratio or kappa, or nodal pressure, "
        "bears more",
        s.stiffness_ratio);
  if (s.pulled) return "the tool pulls or presses harder than the law bears: do so more gently, or grasp more tissue";
  if (!s.loaded)
    return "its own motion, or what was changed last of mesh or material, since no load acts: undo that, or take a "
           "stiffer material";
  return "loads or moved supports deform it more than the law bears: load it more gently, or take a stiffer material";
}

}  // namespace

std::string describe_cause(const FailureDiagnosis& s) { return what(s) + "; most likely " + why(s); }

}  // namespace heml
