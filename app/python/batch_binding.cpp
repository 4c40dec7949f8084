// heml.Batch
#include <fmt/format.h>
#include <nanobind/stl/shared_ptr.h>

#include <algorithm>
#include <app/python/arrays.hpp>
#include <app/python/batch.hpp>
#include <app/python/bindings.hpp>
#include <app/python/errors.hpp>
#include <deque>
#include <heml/base/error.hpp>
#include <limits>

namespace heml::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

/// Holds all worlds of a batch for one call.
class UseAll {
 public:
  explicit UseAll(const Batch& batch) {
    for (const auto& world : batch.worlds()) uses_.emplace_back(*world);
  }

 private:
  std::deque<LiveWorld::Use> uses_;  // as it cannot be moved
};

void step_batch(Batch& batch, long ticks) {
  const UseAll use(batch);
  if (ticks < 0) throw InputError("", "ticks", fmt::format("is {}", ticks), "give 0 or more");
  const nb::gil_scoped_release others_run;
  const bool done = batch.step(ticks, signal_interval, [] {
    const nb::gil_scoped_acquire python;
    return PyErr_CheckSignals() != 0;
  });
  if (done) return;
  const nb::gil_scoped_acquire python;
  nb::raise_python_error();
}

template <NodeVector which>
nb::object batch_vectors(Batch& batch, nb::object out) {
  const UseAll use(batch);
  const auto nodes_of = [](LiveWorld& live) { return live.world().setup().mesh.nodes.size(); };
  std::size_t nodes = 0;
  for (const auto& live : batch.worlds()) nodes = std::max(nodes, nodes_of(*live));
  const Shape shape{static_cast<Py_ssize_t>(batch.worlds().size()), static_cast<Py_ssize_t>(nodes), 3};
  return filled(std::move(out), shape, [&](double* values) {
    for (const auto& live : batch.worlds()) {
      const std::size_t own = 3 * nodes_of(*live);
      live->world().write_vectors(which, {values, own});
      std::fill(values + own, values + 3 * nodes, std::numeric_limits<double>::quiet_NaN());
      values += 3 * nodes;
    }
  });
}

/// Numbers of worlds: one, or a sequence of them.
std::vector<std::size_t> indices_from(const Batch& batch, nb::object given) {
  if (nb::hasattr(given, "tolist")) given = given.attr("tolist")();
  nb::list list;
  if (PyLong_Check(given.ptr()))
    list.append(given);
  else
    list = nb::list(given);
  std::vector<std::size_t> indices;
  for (nb::handle entry : list) {
    long index = -1;
    if (PyBool_Check(entry.ptr()) || !nb::try_cast(entry, index) || index < 0 ||
        static_cast<std::size_t>(index) >= batch.worlds().size())
      throw InputError("", "indices", fmt::format("holds {}", nb::repr(entry).c_str()),
                       fmt::format("give numbers of worlds, 0 to {}", batch.worlds().size() - 1));
    indices.push_back(static_cast<std::size_t>(index));
  }
  return indices;
}

void reset_worlds(Batch& batch, nb::object indices, const Snapshot* snapshot) {
  const UseAll use(batch);
  const std::vector<std::size_t> chosen = indices_from(batch, std::move(indices));
  const nb::gil_scoped_release others_run;
  for (const std::size_t i : chosen) batch.worlds()[i]->restore(snapshot ? *snapshot : batch.start());
}

nb::list worlds_of(const Batch& batch) {
  nb::list list;
  for (const auto& world : batch.worlds()) list.append(world);
  return list;
}

}  // namespace

void bind_batch(nb::module_& module) {
  nb::class_<Batch>(module, "Batch",
                    "n worlds of one scene, stepped by a pool of threads. Each world's bits are those of a lone one.")
      .def(
          "__init__",
          [](Batch* self, nb::object scene, int n, int threads) {
            if (n < 1) throw InputError("", "n", fmt::format("is {}", n), "give 1 or more");
            if (threads < 0) throw InputError("", "threads", fmt::format("is {}", threads), "give 0 or more");
            Scene made = scene_from(scene);
            const nb::gil_scoped_release others_run;
            new (self) Batch(std::move(made), n, threads);
          },
          "scene"_a, "n"_a, "threads"_a = 0, "threads: that compute, one a world; 0: all cores.")
      .def_prop_ro("worlds", &worlds_of, "list of the n worlds: each may be given events and snapshots of its own.")
      .def("__len__", [](const Batch& batch) { return batch.worlds().size(); })
      .def("step", &step_batch, "ticks"_a = 1, "Plays ticks in every world that has not halted (`worlds[i].halt`).")
      .def("positions", &batch_vectors<NodeVector::position>, "out"_a = nb::none(),
           "(n, V, 3) float64, m; V: nodes of the largest world, NaN where a world has fewer; a copy, or `out`.")
      .def("velocities", &batch_vectors<NodeVector::velocity>, "out"_a = nb::none(),
           "(n, V, 3) float64, m/s, as positions().")
      .def("forces", &batch_vectors<NodeVector::force>, "out"_a = nb::none(), "(n, V, 3) float64, N, as positions().")
      .def("reset", &reset_worlds, "indices"_a, "snapshot"_a = nb::none(),
           "Returns worlds to their start, or to a snapshot.");
}

}  // namespace heml::python
