// Explicit steps of a law with one term added to it, interleaved with steps of the law alone.
#include <fmt/format.h>

#include <heml/world/world.hpp>
#include <studies/bench.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/interleaved_timing.hpp>

namespace heml {
namespace {

struct AddedTerm {
  const char* name;
  Material material;
  bool nodal_pressure = false;
};

constexpr const char* shear_field = "shear";  ///< of a material whose shear modulus varies by element

std::vector<AddedTerm> added_terms() {
  const Material bare = bench_material("neo_hookean_iso");
  Material viscous = bare, relaxing = bare, three_branches = bare, other_volume = bare, plastic = bare, varying = bare,
           active = bare;
  viscous.viscosity = 1;
  relaxing.relaxation = {{0.3, 0.1}};
  three_branches.relaxation = {{0.3, 0.1}, {0.2, 1}, {0.1, 10}};
  other_volume.volume_term = VolumeTerm::logarithmic;
  plastic.plasticity = Plasticity{1e6, 0};  // which is never reached
  varying.fields = {{0, shear_field}};
  active.fibre = Vec3::UnitX(), active.active_stress = 100;
  return {{"law alone", bare},
          {"viscosity", viscous},
          {"relaxation", relaxing},
          {"relaxation, 3 branches", three_branches},
          {"another volume term", other_volume},
          {"nodal pressure", bare, true},
          {"plasticity below yield", plastic},
          {"parameter by element", varying},
          {"active stress", active}};
}

/// One row per term, their worlds interleaved.
std::vector<BenchRow> time_terms(const BenchBody& body, bool quadratic, bool single, bool quick) {
  TetMesh mesh = body.mesh;
  MidEdges midedges;
  if (quadratic) midedges = add_midedge_nodes(mesh);
  mesh.fields.push_back(
      {shear_field, 1, std::vector<double>(mesh.tets.size(), added_terms().front().material.parameters[0])});
  const std::vector<AddedTerm> terms = added_terms();
  std::vector<std::unique_ptr<World>> worlds;
  std::vector<std::function<void()>> works;
  std::vector<long> steps, ticks;
  for (const AddedTerm& term : terms) {
    WorldSetup setup = hanging_cube(mesh, term.material);
    setup.midedges = midedges;
    setup.solver.quadratic = quadratic;
    setup.solver.integrator = Integrator::verlet;
    setup.solver.single_precision = single;
    setup.solver.threads = 1;
    setup.solver.nodal_pressure = term.nodal_pressure;
    worlds.push_back(make_world(setup));
    for (int k = 0; k < 3; ++k) worlds.back()->tick();  // warm-up: masses, first step bounds
    works.push_back([world = worlds.back().get()] { world->tick(); });
    steps.push_back(worlds.back()->steps());
    ticks.push_back(worlds.back()->ticks());
  }
  TimingLimits limits;
  limits.seconds = quick ? 0.5 : 6;
  limits.min_rounds = 3;
  limits.min_sample = 0;  // a sample is a tick
  const auto times = time_interleaved(works, limits);
  std::vector<BenchRow> rows;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double a_tick =
        static_cast<double>(worlds[k]->steps() - steps[k]) / static_cast<double>(worlds[k]->ticks() - ticks[k]);
    BenchRow row;
    row.name = fmt::format("verlet, {}{}", quadratic ? "p2, " : "", terms[k].name);
    row.mesh = body.name;
    row.nodes = mesh.nodes.size();
    row.tets = mesh.tets.size();
    row.law = terms[k].material.law;
    row.precision = single ? "float" : "double";
    row.isa = name_of(instruction_sets().back());
    row.unit = "ms";
    row.median = 1e3 * times[k].median / a_tick;
    row.min = 1e3 * times[k].min / a_tick;
    const double median = row.median / (k == 0 ? row : rows.front()).median,
                 least = row.min / (k == 0 ? row : rows.front()).min;
    row.more = {{"spread", times[k].spread},         {"samples", times[k].samples},
                {"step_seconds", 1.0 / 60 / a_tick}, {"ns_per_tet", 1e6 * row.min / static_cast<double>(row.tets)},
                {"times_the_law_alone", least},      {"times_the_law_alone_median", median}};
    if (k > 0) row.remark = fmt::format("{:.2f} times a step of the law alone ({:.2f} by medians)", least, median);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<BenchRow> terms_suite(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  for (const bool quadratic : {false, true}) {
    const BenchBody body = bench_cube((quadratic ? 5 : 9) + (options.quick ? 0 : 4), false);
    for (const bool single : {false, true}) {
      options.progress("terms", (quadratic ? 0.5 : 0.0) + (single ? 0.25 : 0.0));
      for (BenchRow& row : time_terms(body, quadratic, single, options.quick)) rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace heml
