// heml.World
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <app/python/arrays.hpp>
#include <app/python/bindings.hpp>
#include <app/python/errors.hpp>
#include <app/python/json_objects.hpp>
#include <app/python/paths.hpp>
#include <heml/base/error.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/scenario/event_json.hpp>

namespace heml::python {

namespace nb = nanobind;
using namespace nb::literals;

using Use = LiveWorld::Use;

nb::object report_object(World& world, const SolveFacts& facts) {
  return object_from(parse_json(report_text(world, facts), "report"));
}

nb::object node_vectors(const World& world, NodeVector which, nb::object out) {
  const std::size_t nodes = world.setup().mesh.nodes.size();
  return filled(std::move(out), {static_cast<Py_ssize_t>(nodes), 3}, [&](double* values) {
    world.write_vectors(which, {values, 3 * nodes});
  });
}

namespace {

/// A function of the engine's world, as a method.
template <class Function>
auto method(const Function& function) {
  return [function](LiveWorld& live) {
    const Use use(live);
    return function(live.world());
  };
}

template <NodeVector which>
nb::object vectors(LiveWorld& live, nb::object out) {
  const Use use(live);
  return node_vectors(live.world(), which, std::move(out));
}

/// An int32 array, filled by a function.
template <class Fill>
nb::object int_array(const Shape& shape, const Fill& fill) {
  nb::object array = make_array(shape, ElementType::int32);
  const ArrayMemory memory(array, "", shape, ArrayMemory::Access::write, ElementType::int32);
  fill(memory.data<std::int32_t>());
  return array;
}

/// (n, corners) of lists of node numbers.
template <class Corners>
nb::object index_array(const std::vector<Corners>& rows) {
  constexpr Py_ssize_t columns = std::tuple_size_v<Corners>;
  return int_array({static_cast<Py_ssize_t>(rows.size()), columns}, [&](std::int32_t* value) {
    for (const Corners& row : rows) value = std::copy(row.begin(), row.end(), value);
  });
}

nb::object tets(World& world) {
  std::vector<Tet> present;
  for (const int t : world.topology()->elements)
    present.push_back(world.setup().mesh.tets[static_cast<std::size_t>(t)]);
  return index_array(present);
}

nb::object surface(World& world) {
  const TetMesh& mesh = world.setup().mesh;
  const std::vector<int>& elements = world.topology()->elements;
  const bool is_whole = elements.size() == mesh.tets.size();
  return index_array(extract_boundary(is_whole ? mesh : with_elements(mesh, elements)).triangles);
}

nb::object regions(World& world) {
  const std::vector<int> present = with_elements(world.setup().mesh.regions, world.topology()->elements);
  return int_array({static_cast<Py_ssize_t>(present.size())},
                   [&](std::int32_t* value) { std::copy(present.begin(), present.end(), value); });
}

nb::object rest_positions(LiveWorld& live, nb::object out) {
  const Use use(live);
  const std::vector<Vec3>& nodes = live.world().setup().mesh.nodes;
  return filled(std::move(out), {static_cast<Py_ssize_t>(nodes.size()), 3}, [&](double* values) {
    for (const Vec3& node : nodes) values = std::copy(node.begin(), node.end(), values);
  });
}

nb::dict names_of_regions(LiveWorld& live) {
  const Use use(live);
  nb::dict names;
  for (const auto& [region, name] : live.world().setup().mesh.region_names) names[nb::int_(region)] = name;
  return names;
}

nb::object volume_ratios(World& world) {
  const std::vector<double> ratios = world.volume_ratios();
  return filled(nb::none(), {static_cast<Py_ssize_t>(ratios.size())},
                [&](double* out) { std::copy(ratios.begin(), ratios.end(), out); });
}

nb::object stresses(World& world) {
  const std::vector<Mat3> stresses = world.stresses();
  if (stresses.empty())
    throw InputError("", "stresses", "the body has springs, which have forces but no stress",
                     "use materials with an energy of the deformation gradient");
  return filled(nb::none(), {static_cast<Py_ssize_t>(stresses.size()), 3, 3}, [&](double* out) {
    for (const Mat3& stress : stresses)
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) *out++ = stress(row, column);
  });
}

nb::dict energies(World& world) {
  const Energies energies = world.energies();
  nb::dict dict;
  dict["kinetic"] = energies.kinetic;
  dict["elastic"] = energies.elastic;
  dict["potential"] = energies.potential;
  return dict;
}

void step(LiveWorld& live, long ticks) {
  const Use use(live);
  if (ticks < 0) throw InputError("", "ticks", fmt::format("is {}", ticks), "give 0 or more");
  if (live.world().halt()) raise_halt(live.world());
  while (ticks > 0) {
    {
      const nb::gil_scoped_release others_run;
      ticks = live.step(ticks, Clock::now() + signal_interval);
    }
    check_signals();
  }
}

void apply_json(LiveWorld& live, Json event) {
  const Use use(live);
  if (!event.is_object()) throw InputError("", "event", "is no dict", "give one as in a scene's `events`");
  event.erase("at");
  event["step"] = live.world().ticks();
  Script script;
  read_script_entry(JsonCursor(event, "event"), live.world().setup().solver.tick(), script);
  if (script.entries.size() != 1) throw InputError("", "event", "is no action", "give one as in a scene's `events`");
  live.apply(std::move(script.entries[0].event.command), script.entries[0].points);
}

void apply(LiveWorld& live, nb::object event) { apply_json(live, json_from(event, "event")); }

/// An event with one key, whose value is converted.
void apply_action(LiveWorld& live, const char* action, nb::handle value) {
  apply_json(live, {{action, json_from(value, "event", action)}});
}

void grasp(LiveWorld& live, nb::object point, nb::object node, nb::object radius, nb::object hand) {
  nb::dict patch;
  if (!point.is_none()) patch["point"] = point;
  if (!node.is_none()) patch["node"] = node;
  patch["radius"] = radius;
  patch["hand"] = hand;
  apply_action(live, "grasp", patch);
}

void cut(LiveWorld& live, nb::object sweep) {
  if (nb::isinstance<nb::dict>(sweep)) return apply_action(live, "cut", sweep);
  nb::dict value;
  value["sweep"] = sweep;
  apply_action(live, "cut", value);
}

void cauterize(LiveWorld& live, nb::object line, nb::object radius, nb::object shrink) {
  if (nb::isinstance<nb::dict>(line)) return apply_action(live, "cauterize", line);
  nb::dict value;
  value["line"] = line;
  value["radius"] = radius;
  value["shrink"] = shrink;
  apply_action(live, "cauterize", value);
}

std::shared_ptr<Snapshot> snapshot(LiveWorld& live) {
  const Use use(live);
  return live.snapshot();
}

void restore(LiveWorld& live, const Snapshot& snapshot) {
  const Use use(live);
  const nb::gil_scoped_release others_run;  // a snapshot of another process is played first
  live.restore(snapshot);
}

void record(LiveWorld& live, nb::object path) {
  const Use use(live);
  if (path.is_none())
    live.stop_recording();
  else
    live.record(path_text(path));
}

/// Of a closed one it does nothing, as of files. The GIL is held throughout.
void close(LiveWorld& live) {
  if (live.is_closed()) return;
  const Use use(live);
  live.close();
}

nb::object report(LiveWorld& live) {
  const Use use(live);
  return report_object(live.world(), live.facts());
}

void bind_state(nb::class_<LiveWorld>& world) {
  world
      .def_prop_ro("time", method([](World& w) { return w.time(); }),
                   "Simulated time since the start or the last reset, s.")
      .def_prop_ro("ticks", method([](World& w) { return w.ticks(); }), "Whole ticks done.")
      .def_prop_ro("tick", method([](World& w) { return w.setup().solver.tick(); }), "Length of a tick, s.")
      .def_prop_ro("halt", method([](World& w) { return w.halt() ? std::optional(w.halt()->message) : std::nullopt; }),
                   "Why the world has stopped; None while it goes on.")
      .def_prop_ro("topology_version", method([](World& w) { return w.topology()->version; }),
                   "Raised by cuts, tears, removals, their undo, and restore(): read tets and surface again.")
      .def_prop_ro("tets", method(tets),
                   "(T, 4) int32: corners of the elements that are there, by node, in the mesh file's order.")
      .def_prop_ro("surface", method(surface), "(F, 3) int32: triangles of their boundary, by node, seen from outside.")
      .def("regions", method(regions),
           "(T,) int32: region of each element of `tets`, the mesh file's number; 0 where it gives none.")
      .def("region_names", &names_of_regions,
           "dict: names of regions by their number, where the mesh file or the label map names them.")
      .def("rest_positions", &rest_positions, "out"_a = nb::none(),
           "(V, 3) float64, m: positions at rest, without load; nodes as in positions(); a copy, or `out`.")
      .def("positions", &vectors<NodeVector::position>, "out"_a = nb::none(),
           "(V, 3) float64, m, in the mesh file's node order; a copy, or `out`.")
      .def("velocities", &vectors<NodeVector::velocity>, "out"_a = nb::none(), "(V, 3) float64, m/s; a copy, or `out`.")
      .def("forces", &vectors<NodeVector::force>, "out"_a = nb::none(),
           "(V, 3) float64, N: internal forces, gravity, loads and tools, not supports; a copy, or `out`.")
      .def("volume_ratios", method(volume_ratios), "(T,) float64: J = det F of the elements of `tets`.")
      .def("stresses", method(stresses),
           "(T, 3, 3) float64, Pa: Cauchy stress of the elements of `tets`: of law and active stress, without "
           "the parts of viscosity and relaxation.")
      .def("energies", method(energies), "dict: kinetic, elastic, potential (of gravity, 0 at the rest shape), J.")
      .def("hash", method([](World& w) { return fmt::format("{:016x}", w.state_hash()); }),
           "Hash of positions and velocities, bit for bit, as recordings hold it: 16 hexadecimal digits.")
      .def("report", &report, "dict: what `heml solve` writes into report.json, of the present state.");
}

void bind_actions(nb::class_<LiveWorld>& world) {
  world
      .def("step", &step, "ticks"_a = 1,
           "Plays ticks, with the events of the scene. Stops early where the world halts (`halt`); a further call then "
           "raises NotConverged or Unstable. Ctrl+C stops it between two ticks.")
      .def("apply", &apply, "event"_a,
           "Applies an event now: a dict as in a scene's `events`, e.g. {'gravity': [0, 0, 0]}; its `step` and `at` "
           "are ignored.")
      .def("grasp", &grasp, nb::kw_only(), "point"_a = nb::none(), "node"_a = nb::none(), "radius"_a = 0, "hand"_a = 0,
           "Takes hold of the surface nodes within `radius` (m, at rest) of a node, or of the surface node that was "
           "nearest to `point` (m) at rest. Each hand (0 to 15) holds one patch, and all hold at once.")
      .def(
          "move",
          [](LiveWorld& live, nb::object point, nb::object hand) {
            if (hand.equal(nb::int_(0))) return apply_action(live, "move", point);
            nb::dict move;
            move["to"] = point, move["hand"] = hand;
            apply_action(live, "move", move);
          },
          "point"_a, nb::kw_only(), "hand"_a = 0, "Moves the tool of a hand's grasp to a point (m).")
      .def(
          "release",
          [](LiveWorld& live, nb::object hand) {
            nb::dict release;
            release["hand"] = hand;
            apply_action(live, "release", release);
          },
          nb::kw_only(), "hand"_a = 0, "Lets go.")
      .def("cut", &cut, "sweep"_a,
           "Cuts along what a blade sweeps: a list of lines, of two or more points (m) each, from its first place to "
           "its "
           "last; or the whole value of the event `cut`, a dict.")
      .def("cauterize", &cauterize, "line"_a, nb::kw_only(), "radius"_a = 0.005, "shrink"_a = usual_shrink,
           "Burns the tissue within radius (m) of a line of points (m), which loses the part `shrink` of its lengths "
           "where it is coagulated; or the whole value of the event `cauterize`, a dict.")
      .def(
          "undo",
          [](LiveWorld& live) {
            apply_json(live, {{"undo", true}});
          },
          "Takes back the last cut, burn, tear or removal.")
      .def("snapshot", &snapshot, "The whole state, for restore().")
      .def("restore", &restore, "snapshot"_a,
           "Returns to a snapshot of this world or of another of the same scene, whose events and outputs may differ. "
           "A recording ends before it.")
      .def("record", &record, "path"_a.none(),
           "Records from now on into a file that `heml replay --verify` plays; what was done before is written first. "
           "The file is complete after every call. None ends the recording.")
      .def("close", &close, "Ends the recording and frees the world; any later use is an error, but for closing it.")
      .def("__enter__", [](nb::handle self) { return nb::borrow(self); })
      .def("__exit__", [](LiveWorld& live, const nb::args&) { close(live); });
}

}  // namespace

void bind_world(nb::module_& module) {
  nb::class_<LiveWorld> world(module, "World",
                              "A body in motion, made from a scene. Nodes and elements are in the mesh file's order; "
                              "cuts append to them. One thread at a time may use it. SI units.");
  world.def(
      "__init__",
      [](LiveWorld* self, nb::object scene, int threads) {
        if (threads < 0) throw InputError("", "threads", fmt::format("is {}", threads), "give 0 or more");
        Scene made = scene_from(scene);
        const nb::gil_scoped_release others_run;
        new (self) LiveWorld(std::move(made), threads);
      },
      "scene"_a, "threads"_a = 0,
      "scene: a Scene, or what makes one. threads: that compute; 0: as the scene says. The number never changes "
      "a bit.");
  bind_state(world);
  bind_actions(world);
}

}  // namespace heml::python
