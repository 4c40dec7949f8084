#include <fmt/format.h>

#include <chrono>
#include <heml/elastic/body.hpp>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/world/world.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/edit_timing.hpp>
#include <studies/interleaved_timing.hpp>

namespace heml {
namespace {

template <class Work>
double seconds(const Work& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// The mesh after an edit. origins: for each element, the element of the old mesh that it is part of.
struct Edited {
  TetMesh mesh;
  std::vector<int> origins;
};

Edited edited_mesh(const TetMesh& mesh, const MeshEdit& edit) {
  const auto tets = static_cast<int>(mesh.tets.size());
  TetMesh all = mesh;
  append(edit, all);
  const auto elements = apply_edit(full_topology(mesh), edit, tets).elements;
  Edited result{with_elements(all, elements), {}};
  for (const int t : elements)
    result.origins.push_back(t < tets ? t : edit.parents[static_cast<std::size_t>(t - tets)]);
  return result;
}

/// Times of updating a body for an edit, and of rebuilding it from the edited mesh. Each sample starts from `mesh`.
std::array<Timing, 2> time_body(const TetMesh& mesh, const Material& material, const MeshEdit& edit, int samples) {
  const Edited after = edited_mesh(mesh, edit);
  const std::vector<int> before_of(mesh.tets.size(), 0), after_of(after.mesh.tets.size(), 0);
  ElasticBody<float> body(mesh, before_of, {material}, {});
  std::vector<double> updated, rebuilt;
  for (int k = 0; k < samples; ++k) {
    updated.push_back(seconds([&] {
      if (edit.added.empty())
        body.keep_elements(after.origins);
      else
        body.transfer_state(after.mesh, after_of, after.origins);
    }));
    rebuilt.push_back(seconds([&] { body.set_mesh(after.mesh, after_of); }));
    body.set_mesh(mesh, before_of);
  }
  return {summary(updated), summary(rebuilt)};
}

Timing time_command(const TetMesh& mesh, const Material& material, const Command& command, int samples) {
  WorldSetup setup;
  setup.mesh = mesh;
  setup.materials = {{std::nullopt, material}};
  setup.solver.integrator = Integrator::verlet;
  setup.solver.single_precision = true;
  const auto world = make_world(setup);
  std::vector<double> times;
  for (int k = 0; k < samples; ++k) {
    times.push_back(seconds([&] { world->apply(command); }));
    world->apply(Undo{});
  }
  return summary(times);
}

}  // namespace

std::vector<BenchRow> edit_rows(int n, bool quick) {
  constexpr double size = 0.1;
  const double cell = size / n, middle = cell * (n / 2);
  const BenchBody body = bench_cube(n, false);
  const Material material = bench_material("stvk");
  const int samples = quick ? 3 : 9;

  // The cut: three cells deep from the face z = size, five cells long. The removal: a ball of 1.8 cells in the middle.
  const double x = middle + 0.4 * cell, y = middle - 2.5 * cell, deep = size - 2.9 * cell;
  const Sweep sweep{
      {{Vec3(x, y, deep), Vec3(x, y, 2 * size)}, {Vec3(x, y + 5 * cell, deep), Vec3(x, y + 5 * cell, 2 * size)}}};
  RemoveElements removal;
  removal.which.sphere = {Vec3(middle, middle, middle), 1.8 * cell};
  Cut cut;
  MeshEdit gone;
  make_cut(sweep, body.mesh, body.mesh.nodes, full_topology(body.mesh), snapping_distance(body.mesh), {}, cut);
  make_removal_edit(removal.which, body.mesh, full_topology(body.mesh), gone);

  std::vector<BenchRow> rows;
  const auto add = [&](std::string name, const Timing& time, std::string remark) {
    BenchRow& row = rows.emplace_back();
    row.name = std::move(name);
    row.mesh = body.name;
    row.nodes = body.mesh.nodes.size();
    row.tets = body.mesh.tets.size();
    row.law = material.law;
    row.precision = "float";
    row.isa = name_of(instruction_sets().back());
    row.threads = bench_threads().back();
    row.median = 1e3 * time.median;
    row.min = 1e3 * time.min;
    row.unit = "ms";
    row.more = {{"spread", time.spread}, {"samples", time.samples}};
    row.remark = std::move(remark);
  };
  struct Kind {
    const char* name;
    const MeshEdit& edit;
    Command command;
  };
  for (const auto& [name, edit, command] : {Kind{"cut", cut.edit, CutTissue{sweep}}, Kind{"removal", gone, removal}}) {
    const auto [updated, rebuilt] = time_body(body.mesh, material, edit, samples);
    add(fmt::format("{}, layout updated", name), updated,
        fmt::format("{} elements go, {} come; {:.1f} times as fast as rebuilt", edit.removed.size(), edit.added.size(),
                    rebuilt.min / updated.min));
    rows.back().more.update({{"removed", edit.removed.size()}, {"added", edit.added.size()}});
    add(fmt::format("{}, layout rebuilt", name), rebuilt, "");
    add(fmt::format("{}, whole command", name), time_command(body.mesh, material, command, samples),
        "mesh, energies and stable step too");
  }
  return rows;
}

}  // namespace heml
