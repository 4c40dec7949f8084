#include <doctest/doctest.h>

#include <cmath>
#include <heml/base/warning_collector.hpp>
#include <heml/materials/point.hpp>
#include <heml/scenario/feb_scene.hpp>
#include <heml/world/world.hpp>

#include "engine/mesh/files.hpp"
#include "engine/scenario/feb_files.hpp"
#include "engine/scenario/samples.hpp"

namespace heml::feb_scene_test {

using namespace heml::test;

namespace {

struct Import {
  TemporaryFolder folder;
  Scene scene;
  std::vector<std::string> warnings;

  explicit Import(const std::string& text, const BareMeshOptions& options = {}) {
    const WarningCollector collector;
    scene = read_scene(folder.file("model.feb", text), options);
    warnings = collector.texts();
  }
  bool warns(const std::string& part) const {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& text) { return says(text, part); });
  }
};

std::string refusal_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.file("model.feb", text);
  return refusal([&] { read_scene(file); });
}

bool refuses(const std::string& text, const std::string& part) {
  const std::string message = refusal_of(text);
  if (says(message, part)) return true;
  MESSAGE("'", message, "' does not say '", part, "'");
  return false;
}

FebText with_boundary(const std::string& boundary, const std::string& loads = "") {
  FebText with;
  with.boundary = boundary;
  with.loads = loads;
  return with;
}

std::unique_ptr<World> solved(const Scene& scene) {
  auto world = load_world(scene);
  world->load_to(1);
  CHECK_FALSE(world->halt());
  return world;
}

Vec3 sum(const std::vector<Vec3>& vectors) {
  Vec3 all = Vec3::Zero();
  for (const Vec3& each : vectors) all += each;
  return all;
}

/// The lateral stretch at which the neo-Hookean cube bears no lateral stress: μ (b² − 1) + λ ln(a b²) = 0.
double free_stretch(double a, double lambda, double mu) {
  double low = 0.1, high = 3;
  for (int k = 0; k < 200; ++k) {
    const double b = (low + high) / 2;
    (mu * (b * b - 1) + lambda * std::log(a * b * b) < 0 ? low : high) = b;
  }
  return low;
}

std::string pulled(const std::string& version) {
  FebText with;
  with.version = version;
  with.boundary = feb_stretch(version, Vec3(1.4, 0.9, 0.9));
  return feb_cube(with);
}

std::string on_set(const std::string& name, const std::string& type, const std::string& inner) {
  return fmt::format("<bc name=\"move\" type=\"{}\" node_set=\"{}\">{}</bc>", type, name, inner);
}

}  // namespace

TEST_CASE("the cube of every version becomes the same scene") {
  for (const char* version : {"2.5", "3.0", "4.0"}) {
    CAPTURE(version);
    const Import import(pulled(version));
    const Scene& scene = import.scene;
    CHECK(import.warnings.empty());
    CHECK(scene.name == "model");
    CHECK(scene.mesh.file.filename() == "model.feb");
    CHECK(scene.mesh.scale == 1);
    CHECK(scene.solver.is_static());
    CHECK(scene.solver.duration == 1);
    CHECK(scene.solver.rate == 30);  // as of scenes
    CHECK_FALSE(scene.solver.quadratic);
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].region == 1);
    CHECK(scene.materials[1].region == 2);
    CHECK(scene.materials[0].material.law == "neo_hookean");
    CHECK(scene.materials[0].material.density == 1100);
    CHECK(scene.boundary.size() == 8);  // all corners move differently
    const WorldSetup setup = load_setup(scene);
    CHECK(setup.mesh.nodes == unit_cube().nodes);
    CHECK(setup.mesh.region_names == std::map<int, std::string>{{1, "core"}, {2, "shell"}});
  }
}

TEST_CASE("a cube that is stretched along one axis bears the stress of the law's closed form") {
  const double lambda = 1000 * 0.3 / (1.3 * 0.4), mu = 1000 / 2.6, a = 1.4, b = free_stretch(a, lambda, mu);
  for (const char* version : {"2.5", "3.0", "4.0"}) {
    CAPTURE(version);
    FebText with;
    with.version = version;
    with.boundary = feb_stretch(version, Vec3(a, b, b));
    const Import import(feb_cube(with));
    const auto world = solved(import.scene);
    const double J = a * b * b, ln = std::log(J);
    CHECK(world->energies().elastic ==
          doctest::Approx(mu / 2 * (a * a + 2 * b * b - 3) - mu * ln + lambda / 2 * ln * ln).epsilon(1e-10));
    // On the side x = 1 of area 1 at rest: P11 = μ (a − 1/a) + λ ln J / a; nothing across.
    const std::vector<Vec3> reactions = world->reactions();
    Vec3 right = Vec3::Zero(), top = Vec3::Zero();
    for (std::size_t k = 0; k < reactions.size(); ++k) {
      if (import.scene.boundary[k].motion.translate.x() != 0) right += reactions[k];
      if (import.scene.boundary[k].motion.translate.y() != 0) top += reactions[k];
    }
    CHECK(right.x() == doctest::Approx(mu * (a - 1 / a) + lambda * ln / a).epsilon(1e-10));
    CHECK(top.y() == doctest::Approx(0).scale(1000).epsilon(1e-10));
    CHECK(right.y() == doctest::Approx(0).scale(1000).epsilon(1e-10));
  }
}

TEST_CASE("quadratic tetrahedra become p2, with mid-edge nodes held and moved as their corners") {
  // One tetrahedron of unit edges along the axes, held at z = 0 and pulled at its top by 0.5.
  const char* const places[] = {"0,0,0",     "1,0,0",   "0,1,0",   "0,0,1",     "0.5,0,0",
                                "0.5,0.5,0", "0,0.5,0", "0,0,0.5", "0.5,0,0.5", "0,0.5,0.5"};
  std::string nodes;
  for (int n = 0; n < 10; ++n) nodes += fmt::format("<node id=\"{}\">{}</node>", n + 1, places[n]);
  const auto file = [&](const std::string& held) {
    return "<febio_spec version=\"4.0\"><Material><material id=\"1\" name=\"m\" type=\"isotropic elastic\"><E>100</E>"
           "<v>0.2</v></material></Material><Mesh><Nodes>" +
           nodes +
           "</Nodes><Elements type=\"tet10\" name=\"p\"><elem id=\"1\">1,2,3,4,5,6,7,8,9,10</elem></Elements>"
           "<NodeSet name=\"held\">" +
           held +
           "</NodeSet><NodeSet name=\"top\">4</NodeSet><NodeSet name=\"edge\">8</NodeSet>"
           "</Mesh><MeshDomains><SolidDomain name=\"p\" mat=\"m\"/></MeshDomains><Boundary>"
           "<bc type=\"zero displacement\" "
           "node_set=\"held\"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc></Boundary>"
           "<Loads><nodal_load type=\"nodal_load\" node_set=\"top\"><dof>z</dof><scale>2</scale></nodal_load>"
           "<nodal_load type=\"nodal_load\" "
           "node_set=\"edge\"><dof>x</dof><scale>1</scale></nodal_load></Loads></febio_spec>";
  };
  const Import import(file("1,2,3,5,6,7"));
  CHECK(import.warns("tet10 elements: \"element\": \"p2\""));
  CHECK(import.scene.solver.element() == "p2");
  const auto world = solved(import.scene);
  CHECK(world->setup().mesh.nodes.size() == 10);
  CHECK((sum(world->reactions()) - Vec3(-1, 0, -2)).norm() < 1e-6);
  std::string touching = file("1,2,3,5,6,7");
  touching.insert(touching.find("<Loads>"), "<Contact><contact name=\"c\" type=\"sliding-elastic\" surface_pair=\"p\"/>"
                                            "</Contact>");
  CHECK(Import(touching).scene.self_contact);
  CHECK(refuses(file("1,2,3,5,6"), "but not node 6 (from 0) in its middle"));
}

TEST_CASE("forces of nodes, tractions and pressures are FEBio's") {
  SUBCASE("a nodal load is of each node") {
    const Import import(feb_cube(with_boundary(
        feb_held,
        "<nodal_load type=\"nodal_load\" node_set=\"x1\"><dof>y</dof><scale lc=\"1\">2.5</scale></nodal_load>"
        "<nodal_load type=\"nodal_force\" node_set=\"x1\"><value>1,0,0</value></nodal_load>")));
    REQUIRE(import.scene.loads.size() == 2);
    CHECK(import.scene.loads[0].load.vector == Vec3(0, 10, 0));
    CHECK(import.scene.loads[1].load.vector == Vec3(4, 0, 0));
    CHECK(sum(solved(import.scene)->reactions()).isApprox(Vec3(-4, -10, 0), 1e-6));
  }
  SUBCASE("a traction is of the area at rest, with a word") {
    const Import import(feb_cube(with_boundary(
        feb_held,
        "<surface_load type=\"traction\" surface=\"x1\"><scale lc=\"1\">2</scale><traction>3,0,-1</traction>"
        "</surface_load>")));
    CHECK(import.warns("by the area of the surface at rest"));
    CHECK(sum(solved(import.scene)->reactions()).isApprox(Vec3(-6, 0, 2), 1e-6));
  }
  SUBCASE("a positive pressure pushes against the outward normal of the facets") {
    const std::string load =
        "<surface_load type=\"pressure\" surface=\"x1\"><pressure lc=\"1\">5</pressure></surface_load>";
    const std::string text = feb_cube(with_boundary(feb_held, load));
    const Import import(text);
    REQUIRE(import.scene.loads.size() == 1);
    CHECK(import.scene.loads[0].load.pressure == 5);
    CHECK(sum(solved(import.scene)->reactions()).x() > 4.5);
    // Wound the other way the same facets are pulled.
    std::string inward = text;
    const std::size_t at = inward.find("<Surface name=\"x1\">"), end = inward.find("</Surface>", at);
    std::string facets;
    for (const Triangle& f : extract_boundary(unit_cube()).triangles)
      if (unit_cube().nodes[static_cast<std::size_t>(f[0])].x() +
              unit_cube().nodes[static_cast<std::size_t>(f[1])].x() +
              unit_cube().nodes[static_cast<std::size_t>(f[2])].x() ==
          3)
        facets += fmt::format("<tri3 id=\"1\">{},{},{}</tri3>", 10 * (f[1] + 1), 10 * (f[0] + 1), 10 * (f[2] + 1));
    inward.replace(at, end - at, "<Surface name=\"x1\">" + facets);
    CHECK(Import(inward).scene.loads[0].load.pressure == -5);
  }
  SUBCASE("a surface whose nodes hold other faces too is parted") {
    // Both facets of x = 1 and one of y = 1: all four nodes of y = 1 are not held, but those of a facet of x = 1 are.
    std::string text = feb_cube(with_boundary(
        feb_held, "<surface_load type=\"pressure\" surface=\"three\"><pressure>5</pressure></surface_load>"));
    std::string facets;
    const TetMesh cube = unit_cube();
    int count = 0;
    for (const Triangle& f : extract_boundary(cube).triangles) {
      const auto all = [&](int axis) {
        return std::all_of(f.begin(), f.end(),
                           [&](int n) { return cube.nodes[static_cast<std::size_t>(n)][axis] == 1; });
      };
      if (!(all(0) || all(1) || all(2)) || ++count > 5) continue;
      facets += fmt::format("<tri3 id=\"1\">{},{},{}</tri3>", 10 * (f[0] + 1), 10 * (f[1] + 1), 10 * (f[2] + 1));
    }
    text.insert(text.find("<Surface"), "<Surface name=\"three\">" + facets + "</Surface>");
    const Import import(text);
    CHECK(import.scene.loads.size() > 1);
    const WorldSetup setup = load_setup(import.scene);
    std::size_t faces = 0;
    for (const Load& load : setup.loads)
      for (const Triangle& f : extract_boundary(setup.mesh).triangles)
        faces += std::all_of(f.begin(), f.end(),
                             [&](int n) { return std::binary_search(load.nodes.begin(), load.nodes.end(), n); });
    CHECK(faces == 5);
  }
  SUBCASE("a body force pulls against its direction, as FEBio's residual has it") {
    const Import import(
        feb_cube(with_boundary(feb_held, "<body_load type=\"body force\"><force>0,0,9.81</force></body_load>")));
    CHECK(import.scene.gravity == Vec3(0, 0, -9.81));
    CHECK(sum(solved(import.scene)->reactions()).isApprox(Vec3(0, 0, 9.81 * 1100), 1e-6));
    FebText old =
        with_boundary("<fix bc=\"x,y,z\" node_set=\"x0\"/>", "<body_load type=\"const\"><z lc=\"1\">2</z></body_load>");
    old.version = "2.5";
    CHECK(Import(feb_cube(old)).scene.gravity == Vec3(0, 0, -2));
  }
}

TEST_CASE("the file's units, or those that are given, are those of all numbers") {
  FebText with =
      with_boundary(feb_held + on_set("x1", "prescribed displacement", "<dof>x</dof><value lc=\"1\">0.1</value>") +
                        on_set("x1", "zero displacement", "<y_dof>1</y_dof><z_dof>1</z_dof>"),
                    "<nodal_load type=\"nodal_force\" node_set=\"all\"><value>3,0,0</value></nodal_load>"
                    "<surface_load type=\"pressure\" surface=\"y0\"><pressure>0.5</pressure></surface_load>"
                    "<body_load type=\"body force\"><force>0,9810,0</force></body_load>");
  const std::string plain = feb_cube(with);
  with.module = "<Module type=\"solid\"><units>mm-N-s</units></Module>";
  BareMeshOptions options;
  options.unit = LengthUnit{"millimetres", 1e-3};
  for (const bool given : {false, true}) {
    const Import import(given ? plain : feb_cube(with), given ? options : BareMeshOptions{});
    const Scene& scene = import.scene;
    CHECK(scene.mesh.scale == 1e-3);
    CHECK(scene.materials[0].material.parameters[1] == doctest::Approx(1e9 / 2.6));
    CHECK(scene.materials[0].material.density == doctest::Approx(1100e12));
    CHECK(scene.boundary.back().motion.translate.isApprox(Vec3(1e-4, 0, 0)));
    CHECK(scene.loads[0].load.vector == Vec3(24, 0, 0));
    CHECK(scene.loads[1].load.pressure == doctest::Approx(5e5));
    CHECK(scene.gravity.isApprox(Vec3(0, -9.81, 0)));
    CHECK(load_setup(scene).mesh.nodes[7].isApprox(Vec3(1e-3, 1e-3, 1e-3)));
  }
  with.module = "<Module type=\"solid\"><units>parsec</units></Module>";
  CHECK(refuses(feb_cube(with), "the units 'parsec' are not known"));
}

TEST_CASE("a body larger than a room is warned of, with what to write") {
  std::string text = pulled("4.0");
  const std::string far = "<node id=\"900\">60, 0, 0</node>";
  text.insert(text.find("</Nodes>"), far);
  const Import import(text);
  CHECK(import.warns("60 m long, larger than a room"));
  CHECK(import.warns("<units>mm-N-s</units>"));
}

TEST_CASE("dynamics take ramps, the step and the duration") {
  FebText with =
      with_boundary(feb_held + on_set("x1", "prescribed displacement", "<dof>x</dof><value lc=\"1\">0.1</value>") +
                    on_set("x1", "zero displacement", "<y_dof>1</y_dof><z_dof>1</z_dof>"));
  with.control = "<analysis>DYNAMIC</analysis><time_steps>40</time_steps><step_size>0.01</step_size>";
  with.curve = "0,0 0.2,2 0.4,2";
  const Import import(feb_cube(with));
  CHECK(import.scene.solver.integrator == Integrator::tr_bdf2);
  CHECK(import.scene.solver.rate == doctest::Approx(100));
  CHECK(import.scene.solver.duration == doctest::Approx(0.4));
  CHECK(import.scene.boundary.back().motion.ramp_time == doctest::Approx(0.2));
  CHECK(import.scene.boundary.back().motion.translate == Vec3(0.2, 0, 0));
  CHECK(import.warns("TR-BDF2"));
  with.curve = "0,0 0.1,2 0.2,0";
  CHECK(refuses(feb_cube(with), "in dynamics heml has ramps alone"));
  with.control = "<analysis>STATIC</analysis>";
  CHECK_FALSE(Import(feb_cube(with)).scene.boundary.empty());
  CHECK(Import(feb_cube(with)).warns("the end is the same, the way to it is not"));
}

TEST_CASE("sliding contacts become self-contact with their friction") {
  FebText with = with_boundary(feb_held);
  with.extra =
      "<Contact><contact name=\"c\" type=\"sliding-elastic\" "
      "surface_pair=\"p\"><fric_coeff>0.2</fric_coeff></contact></Contact>";
  const Import import(feb_cube(with));
  REQUIRE(import.scene.self_contact);
  CHECK(import.scene.self_contact->friction == 0.2);
  CHECK(import.warns("becomes self-contact of the whole surface"));
  with.extra = "<Contact><contact name=\"glue\" type=\"tied-elastic\" surface_pair=\"p\"/></Contact>";
  CHECK(refuses(feb_cube(with), "<contact> 'glue' of type tied-elastic is not known"));
}

TEST_CASE("the sections of a single step are the file's, and a second step is refused") {
  FebText with;
  const std::string step =
      "<step id=\"1\"><Control><time_steps>5</time_steps><step_size>1</step_size></Control><Boundary>" +
      std::string(feb_held) + "</Boundary></step>";
  with.extra = "<Step>" + step + "</Step>";
  const Import import(feb_cube(with));
  CHECK(import.scene.solver.duration == 5);
  REQUIRE(import.scene.boundary.size() == 1);
  with.extra = "<Step>" + step + step + "</Step>";
  CHECK(refuses(feb_cube(with), "a further step"));
}

TEST_CASE("symmetry planes leave nodes free to slide, and a cube that is pulled on them contracts as the law says") {
  const double lambda = 1000 * 0.3 / (1.3 * 0.4), mu = 1000 / 2.6, a = 1.4, b = free_stretch(a, lambda, mu);
  const Import import(feb_cube(with_boundary(
      on_set("x0", "zero displacement", "<x_dof>1</x_dof>") + on_set("y0", "zero displacement", "<y_dof>1</y_dof>") +
      on_set("z0", "zero displacement", "<z_dof>1</z_dof>") +
      on_set("x1", "prescribed displacement", "<dof>x</dof><value lc=\"1\">0.4</value>"))));
  const auto world = solved(import.scene);
  const std::vector<Vec3> X = load_setup(import.scene).mesh.nodes, x = world->positions();
  for (std::size_t n = 0; n < X.size(); ++n) CHECK((x[n] - Vec3(a, b, b).cwiseProduct(X[n])).norm() < 1e-9);
}

TEST_CASE("a brick becomes quadratic tetrahedra that contract, and bear pressure on its sides, as the law says") {
  const double lambda = 1000 * 0.3 / (1.3 * 0.4), mu = 1000 / 2.6, a = 1.4, b = free_stretch(a, lambda, mu);
  const double P = mu * (a - 1 / a) + lambda * std::log(a * b * b) / a;  // of the side x = 1 at rest
  const auto with_bricks = [](std::string text) {
    const std::size_t from = text.find("<Elements"), to = text.find("<NodeSet");
    text.replace(from, to - from,
                 "<Elements type=\"hex8\" name=\"core\"><elem id=\"1\">10,20,40,30,50,60,80,70</elem></Elements>");
    for (std::size_t at; (at = text.find("<tri3")) < text.size();) text.erase(at, text.find("</tri3>") + 7 - at);
    const std::size_t side = text.find("<Surface name=\"x1\">");
    text.insert(side + 19, "<quad4 id=\"1\">20,40,80,60</quad4>");
    const std::size_t shell = text.find("<SolidDomain name=\"shell\"");
    return text.erase(shell, text.find("/>", shell) + 2 - shell);
  };
  const std::string rollers = on_set("x0", "zero displacement", "<x_dof>1</x_dof>") +
                              on_set("y0", "zero displacement", "<y_dof>1</y_dof>") +
                              on_set("z0", "zero displacement", "<z_dof>1</z_dof>");
  const std::string moved =
      rollers + on_set("x1", "prescribed displacement", "<dof>x</dof><value lc=\"1\">0.4</value>");
  const std::string pressed =
      fmt::format("<surface_load type=\"pressure\" surface=\"x1\"><pressure lc=\"1\">{:.17g}</pressure></surface_load>",
                  -P / (b * b));
  for (const std::string& text : {feb_cube(with_boundary(moved)), feb_cube(with_boundary(rollers, pressed))}) {
    const Import import(with_bricks(text));
    CHECK(import.warns("part 'core' is of hex8 elements: each is divided into tetrahedra"));
    CHECK(import.scene.solver.element() == "p2");
    const auto world = solved(import.scene);
    const std::vector<Vec3> X = load_setup(import.scene).mesh.nodes, x = world->positions();
    CHECK(X.size() == 8 + 12 + 6 + 1);
    for (std::size_t n = 0; n < X.size(); ++n) CHECK((x[n] - Vec3(a, b, b).cwiseProduct(X[n])).norm() < 1e-7);
  }
}

TEST_CASE("all that would change the result is refused in one message with its lines") {
  FebText with = with_boundary(on_set("none", "zero displacement", "<x_dof>1</x_dof>") +
                                   on_set("x1", "normal displacement", ""),
                               "<surface_load type=\"fluid\" surface=\"x1\"/>");
  with.material = "<material id=\"1\" name=\"stuff\" type=\"EFD neo-Hookean\"/>";
  with.extra = "<Rigid><rigid_bc/></Rigid><Output><plotfile/></Output>";
  const std::string message = refusal_of(feb_cube(with));
  for (const char* part :
       {"holds 5 things",
        "names the node_set 'none'", "of type normal displacement is not known",
        "<surface_load> of type fluid is not known", "'stuff' of type EFD neo-Hookean", "<Rigid> is not known"})
    CHECK_MESSAGE(says(message, part), message, " lacks ", part);
  CHECK(message.find('\n') == std::string::npos);
  CHECK_FALSE(says(message, "Output"));
}

TEST_CASE("other refusals name what is wrong") {
  const std::string text = feb_cube(with_boundary(feb_held));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string copy = text;
    const std::size_t at = copy.find(from);
    REQUIRE(at != std::string::npos);
    return copy.replace(at, from.size(), to);
  };
  CHECK(refuses(changed("type=\"tet4\"", "type=\"hex20\""),
                "part 'core' is of hex20 elements; heml computes tet4, tet10, and divides hex8"));
  CHECK(refuses(changed("mat=\"stuff\"", "mat=\"other\""), "part 'core' has no material 'other'"));
  CHECK(refuses(changed("mat=\"stuff\"", "mat=\"stuff\" type=\"ut4-solid\""), "is of the formulation 'ut4-solid'"));
  const std::string brick =
      "<Elements type=\"tet10\" name=\"c\"><elem id=\"9\">10,20,30,50,40,60,70,80,40,60</elem></Elements>";
  CHECK(refuses(changed("<NodeSet", brick + "<NodeSet"), "tet10 and other elements in one body"));
  const std::string bricks =
      "<Elements type=\"hex8\" name=\"d\"><elem id=\"9\">10,20,40,30,50,60,80,70</elem></Elements>";
  CHECK(refuses(changed("<NodeSet", brick + bricks + "<NodeSet"), "tet10 and other elements in one body"));
  CHECK(refuses(changed("type=\"solid\"", "type=\"biphasic\""), "the module is biphasic"));
  CHECK(refuses(changed("<time_steps>10", "<time_steps>0"), "0 time steps"));
  CHECK(refuses(changed("<time_steps>10", "<analysis>fluid</analysis><time_steps>10"), "the analysis is 'fluid'"));
  CHECK(refuses(changed("<Boundary>", "<Boundary from=\"b.feb\">"), "another file is included"));
  CHECK(refuses(text.substr(0, text.size() / 2), "the file is cut off"));
  CHECK(refuses(feb_cube(with_boundary(feb_held,
                                       "<surface_load type=\"pressure\" surface=\"x1\"><pressure>1</pressure>"
                                       "<linear>1</linear></surface_load>")),
                "heml's follows the deformed surface"));
  CHECK(refuses(
      feb_cube(with_boundary(feb_held + on_set("x0", "prescribed displacement", "<dof>x</dof><value>1</value>"))),
      "'wall' of type zero displacement and <bc> 'move' of type prescribed displacement move x of node 0"));
}

TEST_CASE("an imported scene is kept as a scene file that computes the same") {
  const Import import(pulled("4.0"));
  const Scene again = parse_scene(scene_text(import.scene), import.folder / "kept.json");
  CHECK(scene_text(again) == scene_text(import.scene));
  CHECK(load_world(again)->state_hash() == load_world(import.scene)->state_hash());
  CHECK(solved(again)->positions() == solved(import.scene)->positions());
}

}  // namespace heml::feb_scene_test
