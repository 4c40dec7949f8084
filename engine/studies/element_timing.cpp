#include <fmt/format.h>

#include <heml/world/world.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/element_timing.hpp>
#include <studies/interleaved_timing.hpp>

namespace heml {
namespace {

struct Element {
  const char* name;
  TetMesh mesh;
  MidEdges midedges;  ///< empty: linear
  Material material;
};

/// The linear elements first.
std::vector<Element> elements_on_equal_nodes(const BenchBody& body) {
  TetMesh nodes = body.mesh;
  const MidEdges midedges = add_midedge_nodes(nodes);
  std::vector<Element> list = {{"p1", subdivided(nodes, midedges), {}, bench_material("neo_hookean")},
                               {"p2", nodes, midedges, bench_material("neo_hookean")}};
  list.push_back({"p2_pressure", nodes, midedges, bench_material("neo_hookean_iso")});
  return list;
}

WorldSetup hanging(const Element& element, Integrator integrator) {
  WorldSetup setup = hanging_cube(element.mesh, element.material);
  setup.midedges = element.midedges;
  setup.solver.quadratic = !element.midedges.empty();
  setup.solver.nodal_pressure = std::string(element.name) == "p2_pressure";
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  if (is_explicit(integrator)) return setup;
  setup.solver.step = 1.0 / 60;
  setup.solver.budget = Budget{1, 0};
  return setup;
}

/// Times a work of each element in turn; scale: of seconds a run, to ms.
void add_rows(const BenchBody& body, const std::vector<Element>& elements, const std::string& what,
              const std::vector<std::function<void()>>& works, const std::vector<double>& scale, bool quick,
              std::vector<BenchRow>& rows) {
  TimingLimits limits;
  limits.seconds = quick ? 0.5 : 5;
  limits.min_rounds = 3;
  const auto times = time_interleaved(works, limits);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    BenchRow& row = rows.emplace_back();
    row.name = what + ", " + elements[k].name;
    row.mesh = body.name;
    row.nodes = elements[k].mesh.nodes.size();
    row.tets = elements[k].mesh.tets.size();
    row.law = elements[k].material.law;
    row.precision = "double";
    row.isa = name_of(instruction_sets().back());
    row.threads = 1;
    row.unit = "ms";
    row.median = scale[k] * times[k].median;
    row.min = scale[k] * times[k].min;
    row.more = {{"spread", times[k].spread}, {"samples", times[k].samples}};
    if (k == 0) continue;
    const double ratio = row.min / (scale[0] * times[0].min);
    row.more["to_linear"] = ratio;
    row.remark = fmt::format("{:.2f} times linear elements on the same nodes", ratio);
  }
}

}  // namespace

std::vector<BenchRow> element_rows(int n, bool quick) {
  const BenchBody body = bench_cube(n, false);
  const std::vector<Element> elements = elements_on_equal_nodes(body);
  std::vector<BenchRow> rows;
  ThreadTeam alone(1);
  std::vector<std::unique_ptr<ElasticBody<double>>> bodies;
  std::vector<std::vector<double>> forces;
  for (const Element& element : elements) {
    BodyOptions options;
    options.nodal_pressure = std::string(element.name) == "p2_pressure";
    bodies.push_back(std::make_unique<ElasticBody<double>>(element.mesh, std::vector<int>(element.mesh.tets.size(), 0),
                                                           std::vector<Material>{element.material}, options,
                                                           element.midedges));
    forces.emplace_back(3 * element.mesh.nodes.size());
  }
  const double* x = elements[0].mesh.nodes[0].data();  // the same nodes for all
  std::vector<std::function<void()>> works;
  for (std::size_t k = 0; k < elements.size(); ++k)
    works.push_back([&, k] { bodies[k]->forces(x, forces[k].data(), alone); });
  add_rows(body, elements, "forces", works, std::vector<double>(elements.size(), 1e3), quick, rows);
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    std::vector<std::unique_ptr<World>> worlds;
    std::vector<double> scale;
    works.clear();
    for (const Element& element : elements) {
      World& world = *worlds.emplace_back(make_world(hanging(element, integrator)));
      for (int k = 0; k < 3; ++k) world.tick();
      scale.push_back(1e3 * static_cast<double>(world.ticks()) / static_cast<double>(world.steps()));
      works.push_back([&world] { world.tick(); });
    }
    const std::string what = is_explicit(integrator) ? "verlet" : "backward_euler, 1 iteration";
    add_rows(body, elements, what, works, scale, quick, rows);
  }
  return rows;
}

}  // namespace heml
