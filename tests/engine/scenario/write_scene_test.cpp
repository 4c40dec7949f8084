#include <doctest/doctest.h>

#include <bit>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/scene.hpp>
#include <limits>
#include <support.hpp>

namespace heml::write_scene_test {
namespace {

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

/// The command of an event written into a recording and read back.
template <class T>
T reread(const Event& event) {
  const Scene scene = parse_scene(test::scene_with("{}") + "\n" + event_line(event) + "\n", "recording.jsonl");
  REQUIRE(scene.events.size() == 1);
  CHECK(scene.events[0].tick == event.tick);
  return std::get<T>(scene.events[0].command);
}

Scene scene_of_everything() {
  std::mt19937_64 random(7);
  const auto number = [&] { return test::uniform(random, 0.1, 10); };
  const auto vector = [&] { return test::random_vector(random, 3); };
  Scene scene;
  scene.name = "na\"me\n";
  scene.title = "Überschrift";
  scene.description = "text";
  scene.mesh.box = MeshSpec::Box{Vec3(number(), number(), number()), vector(), {2, 3, 4}};
  scene.mesh.scale = number();
  scene.mesh.rotate_axis = vector().normalized();
  scene.mesh.rotate_origin = vector();
  scene.mesh.rotate_degrees = number();
  scene.mesh.translate = vector();
  scene.materials = {{std::nullopt, {"stvk", {number(), number()}, number()}},
                     {-3, {"neo_hookean_iso", {number(), number()}, number()}}};
  scene.boundary.push_back({{{1, 2}, {}, {}}, {{}, vector(), vector().normalized(), vector(), number(), number()}});
  scene.boundary.push_back({{{}, std::array{Vec3(-1, -1, -1), Vec3(1, 2, number())}, {}}, {}});
  scene.boundary.push_back({{{3}, {}, {}}, {}});
  scene.boundary.back().motion.translate = vector();
  scene.boundary.back().motion.axes = {{true, false, true}};
  scene.loads.push_back({{{}, {}, std::pair{vector(), number()}}, {Load::Kind::force, {}, vector(), 0, number()}});
  scene.loads.push_back({{{4}, {}, {}}, {Load::Kind::traction, {}, vector(), 0, 0}});
  scene.loads.push_back({{{4}, {}, {}}, {Load::Kind::pressure, {}, Vec3::Zero(), -number(), 0}});
  scene.markers = {{"tip", {{3}, {}, {}}}, {"", {{}, {}, std::pair{vector(), number()}}}};
  scene.output_history = true;
  scene.output_every = number();
  scene.gravity = vector();
  scene.solver = {.integrator = Integrator::symplectic_euler,
                  .single_precision = true,
                  .step = std::nullopt,
                  .rate = 100 * number(),
                  .duration = number(),
                  .damping = number(),
                  .threads = 3,
                  .continuation = true,
                  .recovery = true,
                  .nodal_pressure = false,
                  .tolerance = number(),
                  .budget = Budget{0, 7.5},
                  .minimiser = Minimiser::lbfgs,
                  .projection = Projection::tension,
                  .preconditioner = Preconditioner::multilevel};
  scene.output_times = {0.05, 0.01};
  scene.output_positions = false;
  scene.output_vtu = true;
  scene.initial_velocity = vector();
  scene.initial_positions = "/folder/start.csv";
  scene.view = {number(), number(), number(), true, Field::von_mises, true, Vec3(0.6, 0, -0.8), number()};
  scene.view.hidden = {2, 5};
  scene.view.range = {-1.5, number()};
  scene.recorded_mesh = MeshFingerprint{60, 120, 0xfedcba9876543210};
  return scene;
}

}  // namespace

TEST_CASE("writes a scene on one line that reads back bit for bit") {
  const Scene scene = scene_of_everything();
  const std::string line = scene_line(scene);
  CHECK(line.find('\n') == line.npos);
  const Scene back = parse_scene(line, "/elsewhere/recording.jsonl");
  CHECK(scene_line(back) == line);
  CHECK(back.name == scene.name);
  CHECK(back.title == scene.title);
  CHECK(back.description == scene.description);
  CHECK(same_bits(back.mesh.box->size, scene.mesh.box->size));
  CHECK(same_bits(back.mesh.box->origin, scene.mesh.box->origin));
  CHECK(back.mesh.box->cells == scene.mesh.box->cells);
  CHECK(same_bits(back.mesh.scale, scene.mesh.scale));
  CHECK(same_bits(back.mesh.rotate_axis, scene.mesh.rotate_axis));
  CHECK(same_bits(back.mesh.rotate_origin, scene.mesh.rotate_origin));
  CHECK(same_bits(back.mesh.rotate_degrees, scene.mesh.rotate_degrees));
  CHECK(same_bits(back.mesh.translate, scene.mesh.translate));
  for (int i = 0; i < 2; ++i) {
    CHECK(back.materials[i].region == scene.materials[i].region);
    CHECK(back.materials[i].material.law == scene.materials[i].material.law);
    CHECK(back.materials[i].material.parameters == scene.materials[i].material.parameters);
    CHECK(back.materials[i].material.density == scene.materials[i].material.density);
    CHECK(back.boundary[i].where.nodes == scene.boundary[i].where.nodes);
    CHECK(back.boundary[i].where.box == scene.boundary[i].where.box);
    CHECK(same_bits(back.boundary[i].motion.translate, scene.boundary[i].motion.translate));
    CHECK(same_bits(back.boundary[i].motion.origin, scene.boundary[i].motion.origin));
    CHECK(same_bits(back.boundary[i].motion.axis, scene.boundary[i].motion.axis));
    CHECK(same_bits(back.boundary[i].motion.degrees, scene.boundary[i].motion.degrees));
    CHECK(same_bits(back.boundary[i].motion.ramp_time, scene.boundary[i].motion.ramp_time));
    CHECK(back.boundary[i].motion.axes == scene.boundary[i].motion.axes);
  }
  for (int i = 0; i < 3; ++i) {
    CHECK(back.loads[i].where.nodes == scene.loads[i].where.nodes);
    CHECK(back.loads[i].where.sphere == scene.loads[i].where.sphere);
    CHECK(back.loads[i].load.kind == scene.loads[i].load.kind);
    CHECK(same_bits(back.loads[i].load.vector, scene.loads[i].load.vector));
    CHECK(same_bits(back.loads[i].load.pressure, scene.loads[i].load.pressure));
    CHECK(same_bits(back.loads[i].load.ramp_time, scene.loads[i].load.ramp_time));
  }
  CHECK(same_bits(back.gravity, scene.gravity));
  CHECK(back.solver.integrator == scene.solver.integrator);
  CHECK(back.solver.single_precision);
  CHECK(same_bits(back.solver.rate, scene.solver.rate));
  CHECK(same_bits(back.solver.duration, scene.solver.duration));
  CHECK(same_bits(back.solver.damping, scene.solver.damping));
  CHECK(back.solver.threads == 3);
  CHECK(back.solver.continuation);
  CHECK(!back.solver.nodal_pressure);
  CHECK(same_bits(back.solver.tolerance.value(), *scene.solver.tolerance));
  CHECK(same_bits(back.solver.budget.value().milliseconds, scene.solver.budget->milliseconds));
  CHECK(back.solver.recovery == scene.solver.recovery);
  CHECK(back.solver.minimiser == scene.solver.minimiser);
  CHECK(back.solver.projection == scene.solver.projection);
  CHECK(back.solver.preconditioner.value() == *scene.solver.preconditioner);
  CHECK(back.output_times == scene.output_times);
  CHECK(!back.output_positions);
  CHECK(back.output_vtu);
  CHECK(same_bits(back.initial_velocity, scene.initial_velocity));
  CHECK(back.initial_positions == scene.initial_positions);
  CHECK(back.view.azimuth == scene.view.azimuth);
  CHECK(back.view.elevation == scene.view.elevation);
  CHECK(back.view.zoom == scene.view.zoom);
  CHECK(back.view.field == Field::von_mises);
  CHECK(back.view.orthographic);
  CHECK(back.view.wireframe);
  CHECK(back.view.hidden == scene.view.hidden);
  CHECK(back.view.range == scene.view.range);
  REQUIRE(back.view.section);
  CHECK((*back.view.section - *scene.view.section).norm() < 1e-15);
  CHECK(back.view.section_at == scene.view.section_at);
  CHECK(back.recorded_mesh == scene.recorded_mesh);
}

TEST_CASE("keeps the element") {
  const Scene scene = test::small_scene_with(R"({"solver": {"element": "nodal_pressure"},
      "materials": [{"law": "neo_hookean_iso", "K1": 500, "kappa": 5e4}]})");
  CHECK(scene.solver.nodal_pressure);
  CHECK(parse_scene(scene_line(scene), "recording.jsonl").solver.nodal_pressure);
}

TEST_CASE("keeps a step bit for bit, and the parts of a surface") {
  Scene scene = scene_of_everything();
  scene.solver.step = 0.1 / 3;
  scene.mesh.box.reset();
  scene.mesh.surface = "/meshes/liver.obj";
  scene.mesh.radius_edge_ratio = 1.7;
  scene.mesh.max_volume = 1e-7 / 3;
  scene.output_times = {};
  const Scene back = parse_scene(scene_line(scene), "x.jsonl");
  CHECK(back.solver.step == scene.solver.step);
  CHECK(back.mesh.surface == "/meshes/liver.obj");
  CHECK(back.mesh.radius_edge_ratio == 1.7);
  CHECK(back.mesh.max_volume == scene.mesh.max_volume);
}

TEST_CASE("writes paths below the recording's folder relative to it, others as absolute") {
  Scene scene = test::small_scene_with("{}");
  scene.mesh.box.reset();
  scene.mesh.file = "/study/meshes/a.msh";
  CHECK(parse_scene(scene_line(scene, "/study"), "/moved/r.jsonl").mesh.file == "/moved/meshes/a.msh");
  CHECK(parse_scene(scene_line(scene, "/study/recordings"), "/moved/r.jsonl").mesh.file == "/study/meshes/a.msh");
  CHECK(parse_scene(scene_line(scene), "/moved/r.jsonl").mesh.file == "/study/meshes/a.msh");
}

TEST_CASE("writes every kind of event so that it reads back bit for bit") {
  std::mt19937_64 random(11);
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  for (int round = 0; round < 200; ++round) {
    const double scale = std::pow(10.0, test::uniform(random, -300, 300));
    const Vec3 v = test::random_vector(random, scale);
    CHECK(same_bits(reread<MoveTool>({round, MoveTool{v}}).target, v));
    CHECK(same_bits(reread<SetDamping>({round, SetDamping{scale}}).damping, scale));
  }
  for (const Vec3& v : {Vec3(-0.0, least, -most), Vec3(0.1, 1.0 / 3, 1e22)}) {
    CHECK(same_bits(reread<MoveTool>({0, MoveTool{v}}).target, v));
    CHECK(same_bits(reread<SetGravity>({999999999999, SetGravity{v}}).gravity, v));
  }
  CHECK(reread<SetBudget>({5, SetBudget{17}}).iterations == 17);
  CHECK(same_bits(reread<SetRate>({5, SetRate{100.0 / 3}}).rate, 100.0 / 3));
  CHECK(same_bits(reread<SetStepCost>({5, SetStepCost{0.1 / 3}}).nanoseconds, 0.1 / 3));
  const Grasp grasp = reread<Grasp>({5, Grasp{12, 0.1 / 3}});
  CHECK(grasp.node == 12);
  CHECK(same_bits(grasp.radius, 0.1 / 3));
  const SetMaterial material = reread<SetMaterial>({5, SetMaterial{-7, {"stvk", {0.1 / 3, 0.2 / 3}, 0.7}}});
  CHECK(material.region == -7);
  CHECK(material.material.law == "stvk");
  CHECK(material.material.parameters == std::vector<double>{0.1 / 3, 0.2 / 3});
  CHECK(material.material.density == 0.7);
  CHECK(!reread<SetMaterial>({5, SetMaterial{std::nullopt, {"neo_hookean", {1, 1}, 1}}}).region);
  const SetIntegrator euler{Integrator::symplectic_euler};
  CHECK(reread<SetIntegrator>({5, euler}).integrator == Integrator::symplectic_euler);
  reread<Release>({5, Release{}});
  CHECK_FALSE(reread<Reset>({5, Reset{}}).scene);
  CHECK(reread<Reset>({5, Reset{true}}).scene);
  CHECK(reread<PinTissue>({5, PinTissue{0, 0, {}, {4, 1}}}).nodes == std::vector{4, 1});
  CHECK(reread<Unpin>({5, Unpin{{}, {4, 1}}}).nodes == std::vector{4, 1});
  for (const RegionTag& tag : {RegionTag{{0, 7}, {}, "a b", {}}, RegionTag{{}, {{3}, {}, {}, {}}, "c", -2},
                               RegionTag{{}, {{}, {}, {}, std::pair(Vec3(0.1, 0, 0), 0.1 / 3)}, "d", {}}}) {
    const TagRegion region = reread<TagRegion>({5, TagRegion{tag, Material{"stvk", {0.1 / 3, 0.2 / 3}, 0.7}}});
    CHECK(region.tag == tag);
    CHECK(region.material == Material{"stvk", {0.1 / 3, 0.2 / 3}, 0.7});
    CHECK_FALSE(reread<TagRegion>({5, TagRegion{tag, {}}}).material);
  }
}

TEST_CASE("regions of a scene read back, and the mesh has them") {
  const Scene scene = test::small_scene_with(R"({
    "regions": [{"tets": [0, 3], "name": "lesion", "number": 7}, {"sphere": [[0, 0, 0], 9], "name": "all"}],
    "materials": [{"law": "stvk", "young": 1, "poisson": 0}, {"region": 8, "law": "stvk", "young": 2, "poisson": 0}]
  })");
  CHECK(parse_scene(scene_text(scene), "folder/scene.json").regions == scene.regions);
  const TetMesh mesh = load_setup(scene).mesh;
  CHECK(mesh.regions == std::vector<int>(mesh.tets.size(), 8));  // the later entry wins
  CHECK(mesh.region_names == std::map<int, std::string>{{7, "lesion"}, {8, "all"}});
  const auto refused = [](const std::string& regions) {
    return refusal([&] { load_setup(test::small_scene_with(R"({"regions": [)" + regions + "]}")); });
  };
  CHECK(says(refused(R"({"tets": [0], "name": "a", "number": 4}, {"tets": [1], "name": "b", "number": 4})"),
             {"regions[1]", "region 4 is named 'a', not 'b'"}));
  CHECK(says(refused(R"({"nodes": [0], "name": "a"})"), {"regions[0]", "no element has all its corners"}));
  CHECK(says(refused(R"({"nodes": [0]})"), {"regions[0]", "name"}));
  CHECK(says(refused(R"({"name": "a"})"), {"regions[0]", "nodes"}));
}

TEST_CASE("normals of tables read back bit for bit, of a scene and of an event") {
  std::mt19937_64 random(11);
  for (int k = 0; k < 100; ++k) {
    const Json tables = {
        {{"point", {0, 0, 0}}, {"normal", {test::uniform(random, -1, 1), test::uniform(random, -1, 1), 1}}}};
    const std::string patch = Json{{"tables", tables}, {"events", {{{"step", 1}, {"tables", tables}}}}}.dump();
    const Scene scene = test::small_scene_with(patch), again = parse_scene(scene_text(scene), "folder/scene.json");
    CHECK(same_bits(again.tables[0].normal, scene.tables[0].normal));
    const auto normal = [](const Scene& of) { return std::get<SetTables>(of.events[0].command).tables[0].normal; };
    CHECK(same_bits(normal(again), normal(scene)));
  }
}

TEST_CASE("writes checkpoints so that they read back") {
  const Checkpoint checkpoint{123, 0x00ab00000000cdef, {0, 1, 0xffff}};
  const Scene scene = parse_scene(test::scene_with("{}") + "\n" + checkpoint_line(checkpoint), "recording.jsonl");
  REQUIRE(scene.checkpoints.size() == 1);
  CHECK(scene.checkpoints[0].tick == 123);
  CHECK(scene.checkpoints[0].hash == checkpoint.hash);
  CHECK(scene.checkpoints[0].nodes == checkpoint.nodes);
}

TEST_CASE("refuses to write what is not UTF-8") {
  Scene scene = test::small_scene_with("{}");
  scene.name = std::string("\xff");
  CHECK(says(refusal([&] { scene_line(scene); }), "not UTF-8"));
}

}  // namespace heml::write_scene_test
