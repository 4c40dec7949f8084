#include <fmt/format.h>

#include <algorithm>
#include <app/panel/plot.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/readings.hpp>
#include <app/panel/volume.hpp>
#include <app/render/grasp_pose.hpp>

namespace heml::panel {
namespace {

void draw_force(Rows& rows, const Frame& frame, const History& history) {
  const std::optional<double> force = force_of_hands(frame.tools);
  ImGui::BeginGroup();
  {
    const UseFont number(Font::number);
    ImGui::PushStyleColor(ImGuiCol_Text, force ? colours::accent : colours::faint);
    ImGui::TextUnformatted(newtons(force.value_or(0)).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::EndGroup();
  rows.explain({"Force", "Magnitude of the force between grasper and tissue, N; of the hand that pulls most."});
  double clamps = 0;
  std::size_t clamp_count = 0;
  for (const GraspState& clamp : tools_of<GraspState>(frame.tools))
    if (render::is_clamp(clamp)) clamps = std::max(clamps, clamp.force.norm()), ++clamp_count;
  if (clamp_count > 0)
    rows.value({"Clamps", "The largest force of a clamp on the tissue, N."}, newtons(clamps), colours::potential);
  if (find_tool<PinState>(frame.tools))
    rows.value({"Pins", "Magnitude of the sum of the pins' forces on the tissue, N."},
               newtons(force_of<PinState>(frame.tools).norm()), colours::potential);
  if (find_tool<ProbeState>(frame.tools))
    rows.value({"Probe", "Magnitude of the force between probe and tissue, including friction, N."},
               newtons(force_of<ProbeState>(frame.tools).norm()), colours::warning);
  if (const TableState* table = find_tool<TableState>(frame.tools)) {
    rows.value(
        {"Table", "Magnitude of the force of the table on the tissue, N; at equilibrium the weight of the tissue."},
        newtons(force_of<TableState>(frame.tools).norm()), colours::kinetic);
    rows.value({"Contact points", "Points of the tissue in contact with the table."},
               fmt::format("{}", table->contact_count));
  }
  double tightest = 0;
  const std::vector<SutureState> sutures = tools_of<SutureState>(frame.tools);
  for (const SutureState& suture : sutures) tightest = std::max(tightest, suture.force.norm());
  if (!sutures.empty())
    rows.value({"Sutures", "Tension of the tightest thread, N."}, newtons(tightest), colours::danger);
  const Curve curves[] = {{"Grasp", colours::accent, [](const Reading& r) { return r.force; }},
                          {"Pins", colours::potential, [](const Reading& r) { return r.pins; }},
                          {"Probe", colours::warning, [](const Reading& r) { return r.probe; }},
                          {"Table", colours::kinetic, [](const Reading& r) { return r.tables; }},
                          {"Sutures", colours::danger, [](const Reading& r) { return r.sutures; }}};
  plot("force plot", history, curves, {"N", 0, 1e-3, 3.8f});
}

void draw_energies(Rows& rows, const Frame& frame, const History& history) {
  const Energies& now = frame.energies;
  rows.value({"Kinetic", "Energy of motion, J: ½ m v² over all nodes."}, quantity(now.kinetic, "J"), colours::kinetic);
  rows.value({"Elastic", "Energy stored in the deformed tissue, J."}, quantity(now.elastic, "J"), colours::elastic);
  rows.value({"Gravity energy", "Potential energy of gravity, J; 0 at the rest shape."}, quantity(now.potential, "J"),
             colours::potential);
  rows.value({"Total", "Sum of the three, J. Constant without damping and tools."},
             quantity(now.kinetic + now.elastic + now.potential, "J"), colours::text);
  const Curve curves[] = {
      {"Total", colours::text, [](const Reading& r) { return r.total(); }},
      {"Gravity", colours::potential, [](const Reading& r) { return r.energies.potential; }},
      {"Elastic", colours::elastic, [](const Reading& r) { return r.energies.elastic; }},
      {"Kinetic", colours::kinetic, [](const Reading& r) { return r.energies.kinetic; }},
  };
  plot("energy plot", history, curves, {"J", 0, 1e-9, 4.7f});
}

void draw_volume(Rows& rows, const Frame& frame, const History& history) {
  const bool inverted = !(frame.min_J > 0);
  const bool is_part = frame.surface_mesh && !frame.surface_mesh->hidden.empty();
  if (frame.surface_mesh) {
    const double now = enclosed_volume(*frame.surface_mesh, frame.positions),
                 rest = enclosed_volume(*frame.surface_mesh);
    rows.value(is_part
                   ? Label{"Shown regions",
                           "Volume of the shown regions alone, cm³, and relative to rest. The section Regions shows "
                           "the others again."}
                   : Label{"Body volume", "Volume of the body, cm³, and relative to rest."},
               fmt::format("{:.4g} cm³, {:.1f} %", now * 1e6, 100 * now / rest), colours::text);
  }
  rows.value({"Min J", "Smallest volume ratio of a tetrahedron; 0 or less: inverted."},
             fmt::format("{:.3f}", frame.min_J), colours::potential, inverted ? colours::danger : colours::text);
  rows.value({"Max J", "Largest volume ratio of a tetrahedron."}, fmt::format("{:.3f}", frame.max_J), colours::kinetic);
  if (frame.removed > 0)
    rows.value({"Removed", "Removed tetrahedra, of all. Reset restores them."},
               fmt::format("{} of {}", frame.removed, frame.elements));
  if (frame.last_edit && frame.last_edit->torn > 0)
    rows.value({"Torn", "Area of one side of the tear, in the state in which it tore. Undo restores all of it."},
               fmt::format("{:.3g} cm²", frame.last_edit->area * 1e4));
  if (frame.last_edit && frame.last_edit->split > 0) {
    const EditReport& cut = *frame.last_edit;
    rows.value({"Last cut", "Area of one side of the last cut, in the state in which it was made."},
               fmt::format("{:.3g} cm²", cut.area * 1e4));
    rows.value({"Min dihedral angle",
                "Dihedral angle of the worst new tetrahedron of the last cut, degrees, at rest. Slivers "
                "have less than 5°."},
               fmt::format("{:.0f}°", cut.min_angle));
    rows.value({"Step, before and after", "The longest stable step of explicit methods before and after the last cut."},
               fmt::format("{}, {}", quantity(cut.step_before, "s"), quantity(cut.step_after, "s")));
  }
  const Curve curves[] = {
      {"Min", colours::potential, [](const Reading& r) { return r.min_J; }},
      {"Max", colours::kinetic, [](const Reading& r) { return r.max_J; }},
      {is_part ? "Shown" : "Whole", colours::text, [](const Reading& r) { return r.volume; }},
  };
  plot("volume plot", history, curves, {"", 1, 0.01, 3.6f});
}

void draw_errors(Rows& rows, const Frame& frame, const History& history) {
  rows.value(
      {"Mesh error",
       "Estimated discretisation error, % of the energy norm (Zienkiewicz and Zhu: stress against fits to patches). "
       "Roughly proportional to edge length; colours (6) show where it is. It does not include locking or time "
       "errors."},
      frame.mesh_error ? fmt::format("{:.1f} %", 100 * *frame.mesh_error) : "–", colours::accent);
  const auto& time = frame.time_error;
  rows.value(
      {"Time error",
       "Estimated rms position error of the time integration over the last 0.1 s, mm, by step doubling: a copy of the "
       "body repeats some intervals with half the step. Not after cuts, and not for tissue with internal state "
       "(viscosity, plasticity)."},
      time ? fmt::format("{:.2g} mm", 1e3 * time->rms) : "–", colours::warning);
  rows.value({"Max time error", "Time error of the worst node, mm."},
             time ? fmt::format("{:.2g} mm", 1e3 * time->max) : "–", 0);
  const Curve mesh_curve[] = {{"Mesh", colours::accent, [](const Reading& r) { return r.mesh_error; }}};
  plot("mesh error plot", history, mesh_curve, {"%", 0, 1, 3.4f});
  const Curve time_curve[] = {{"Steps", colours::warning, [](const Reading& r) { return r.time_error; }}};
  plot("time error plot", history, time_curve, {"mm", 0, 1e-6, 3.4f});
}

void draw_engine(Rows& rows, const Frame& frame, const History& history) {
  const Pace& pace = frame.pace;
  const auto time_of = [](double seconds) { return seconds > 0 ? quantity(seconds, "s") : std::string("–"); };
  const double steps = frame.substeps > 0 ? frame.substeps : 1;
  rows.value({"Time per step", "Wall time of computing one integration step, s: median over the last second."},
             time_of(pace.p50 / steps), 0);
  rows.value({"Time per tick", "Wall time of computing one tick, s: median over the last second."}, time_of(pace.p50),
             colours::accent);
  rows.value({"99th percentile", "99th percentile of the wall time per tick over the last second, s."},
             time_of(pace.p99), colours::warning);
  rows.value({"Rate", "Ticks per simulated second, Hz; set by the scene (solver.rate or solver.step)."},
             fmt::format("{:.4g} Hz", pace.rate));
  rows.value({"Steps per tick", "Substeps per tick, chosen for stability."}, fmt::format("{}", frame.substeps));
  rows.value(
      {"Stable step",
       "Longest stable step of explicit methods now, s, safety factor included. Stiffer, lighter or finer bodies have "
       "shorter ones."},
      time_of(frame.stable_step));
  if (frame.explicit_rescues > 0)
    rows.value({"Explicit rescues",
                "Ticks in which implicit steps did not converge and explicit substeps took their place, since the "
                "start."},
               grouped_digits(frame.explicit_rescues), 0, colours::warning);
  if (frame.unconverged_steps > 0)
    rows.value({"Unconverged steps",
                "Implicit steps that ended with their best iterate, since neither they nor explicit substeps could "
                "finish, since the start. Their energy is limited; their positions are inaccurate."},
               grouped_digits(frame.unconverged_steps), 0, colours::warning);
  rows.value({"Missed deadlines", "Ticks that ended after their deadline, since the start."},
             grouped_digits(pace.missed), 0, pace.missed > 0 && !pace.keeping_up ? colours::warning : colours::text);
  rows.value({"Threads",
              "Threads of the engine, and cores used by the rest of the program (mostly drawing). The engine uses the "
              "remaining cores unless the scene sets solver.threads; results do not depend on it."},
             fmt::format("{}, drawing {:.1f} cores", pace.threads, pace.others));
  const Curve curves[] = {
      {"Slowest", colours::warning, [](const Reading& r) { return r.slow_tick; }},
      {"Typical", colours::accent, [](const Reading& r) { return r.typical_tick; }},
  };
  plot("tick plot", history, curves, {"s", 0, 1e-6, 3.4f});
  rows.value({"Slowdown", "Wall seconds per simulated second, over the last second: 1 is real time, 2 half as fast."},
             pace.slowdown < 1e8 ? fmt::format("{:.2f} ×", pace.slowdown) : "–", colours::potential);
  const Curve late[] = {{"Slowdown", colours::potential, [](const Reading& r) { return std::min(r.slowdown, 100.0); }}};
  plot("lateness plot", history, late, {"×", 1, 0.5, 2.9f});
}

}  // namespace

bool draw_readings(Rows& rows, const Frame& frame, const History& history) {
  if (rows.section("Tool force")) draw_force(rows, frame, history);
  if (rows.section("Energy")) draw_energies(rows, frame, history);
  if (rows.section("Volume")) draw_volume(rows, frame, history);
  if (rows.section("Engine")) draw_engine(rows, frame, history);
  const bool shows_errors = rows.section("Accuracy", false);
  if (shows_errors) draw_errors(rows, frame, history);
  return shows_errors;
}

}  // namespace heml::panel
