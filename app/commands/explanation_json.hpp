#pragma once
// The output of `heml explain --json`. Keys may be added but never change. SI units; times in s except "milliseconds"
// and "saved"; null where a value does not exist.
//
//   scene, name    file and name
//   body           nodes, tets, live_tets, regions, components, held_nodes, boundary_faces, volume, shortest_edge,
//                  longest_edge, worst_dihedral (degrees), worst_tet, slivers
//   materials[]    region, law, tets, kernel, instructions, bytes_per_tet, operations_per_tet (multiplications,
//                  additions, others; null for springs), terms[] (name, detail), density, shear_modulus, bulk_modulus,
//                  poisson
//   method         asked, integrator, precision, element, threads, tick, step_given, steps_a_tick, stable_step; basis
//                  of "auto": step_cost, explicit_share, explicit_enough, lowest_frequency (1/s),
//                  tick_times_frequency, resolved_below
//   limit          the element that limits explicit steps: element, cause (none, sliver, small, stiff), share (of the
//                  bound of ω²), over_median, dihedral, height, median_height, wave_speed, median_wave_speed
//   solver         minimiser, preconditioner, chosen_by_size, free_nodes, levels, projection, tolerance,
//                  budget_iterations, budget_milliseconds; null for explicit methods
//   tools[]        name, detail, times, first, last (s)
//   memory         bytes: elements, mesh, state, recovery, factors, solver vectors, all
//   startup[]      what, seconds
//   left_out[]     feature, why
//   warnings[]     about (an identifier), text, remedy
//   measured       stretch, turns, largest_motion, changes[] (feature, from, to, milliseconds per tick, saved, steps,
//                  error in m, halted); null without --measure
#include <heml/scenario/explain.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/measure_features.hpp>
#include <optional>

namespace heml {

Json explanation_json(const Explanation& explained, const std::optional<Measurement>& measured);

}  // namespace heml
