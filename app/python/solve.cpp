// heml.solve() and heml.probe()
#include <fmt/format.h>

#include <Eigen/Core>
#include <app/python/arrays.hpp>
#include <app/python/bindings.hpp>
#include <app/python/errors.hpp>
#include <app/python/json_objects.hpp>
#include <future>
#include <heml/base/error.hpp>
#include <heml/materials/point.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/solve.hpp>
#include <limits>

namespace heml::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

/// Solves on another thread, while this one lets handlers of signals run: one that raises stops the solve.
SolveFacts solve_interruptibly(const Scene& scene, World& world) {
  std::atomic<bool> stopped{false};
  auto solved = std::async(std::launch::async, [&] { return heml::solve(scene, world, [&] { return !stopped; }); });
  while (true) {
    {
      const nb::gil_scoped_release others_run;
      if (solved.wait_for(signal_interval) == std::future_status::ready) break;
    }
    try {
      check_signals();
    } catch (...) {
      const nb::gil_scoped_release others_run;
      stopped = true;
      world.interrupt();
      solved.wait();
      throw;
    }
  }
  return solved.get();
}

nb::tuple solve(nb::object given, int threads) {
  if (threads < 0) throw InputError("", "threads", fmt::format("is {}", threads), "give 0 or more");
  Scene scene = scene_from(given);
  if (threads > 0) scene.solver.threads = threads;
  const auto world = load_world(scene);
  const SolveFacts facts = solve_interruptibly(scene, *world);
  nb::object positions = node_vectors(*world, NodeVector::position, nb::none());
  nb::object report = report_object(*world, facts);
  if (facts.halt) raise_halt(*world, positions, report);
  return nb::make_tuple(positions, report);
}

using Matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

double* write(const Mat3& matrix, double* out) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) *out++ = matrix(row, column);
  return out;
}

nb::dict probe(nb::object material, nb::object given_F, nb::object given_dF) {
  const Json json = json_from(material, "material");
  const Material law = lone_material_from(JsonCursor(json, "material"));
  if (!find_law(law.law)->is_continuum)
    throw InputError("material", "law", fmt::format("'{}' has no energy of the deformation gradient", law.law),
                     "give a law that has one");
  if ((law.active_stress > 0 || law.has_internal_state()) &&
      PyErr_WarnEx(PyExc_UserWarning,
                   "material: the law alone is evaluated, without active stress, viscosity, relaxation and plasticity",
                   1) < 0)
    throw nb::python_error();
  given_F = input_array(given_F, "F", {-1, 3, 3});
  const ArrayMemory F(given_F, "F", {-1, 3, 3}, ArrayMemory::Access::read);
  const Py_ssize_t n = F.extent(0);
  const bool has_dF = !given_dF.is_none();
  if (has_dF) given_dF = input_array(given_dF, "dF", {n, 3, 3});
  const ArrayMemory dF(has_dF ? given_dF : given_F, "dF", {n, 3, 3}, ArrayMemory::Access::read);
  nb::object W = make_array({n}), P = make_array({n, 3, 3}), dP = has_dF ? make_array({n, 3, 3}) : nb::none();
  const auto memory = [&](const nb::object& array, const Shape& shape) {
    return ArrayMemory(array, "", shape, ArrayMemory::Access::write).data<double>();
  };
  double *w = memory(W, {n}), *p = memory(P, {n, 3, 3}), *dp = has_dF ? memory(dP, {n, 3, 3}) : nullptr;
  {
    const nb::gil_scoped_release others_run;
    const auto point = make_material_point(law, false);
    const Mat3 nan = Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
    for (Py_ssize_t i = 0; i < n; ++i) {
      const Mat3 at = Matrix(F.data<const double>() + 9 * i);
      const bool valid = point->valid(at);
      *w++ = valid ? point->energy(at) : nan(0, 0);
      p = write(valid ? point->first_piola(at) : nan, p);
      if (!has_dF) continue;
      const Mat3 along = Matrix(dF.data<const double>() + 9 * i);
      dp = write(valid ? point->first_piola_differential(at, along) : nan, dp);
    }
  }
  nb::dict result;
  result["W"] = W;
  result["P"] = P;
  if (has_dF) result["dP"] = dP;
  return result;
}

}  // namespace

void bind_solve(nb::module_& module) {
  module.def("solve", &solve, "scene"_a, "threads"_a = 0,
             "Runs a scene as `heml solve` does, to the same bits: static equilibrium, or dynamics up to its duration. "
             "Returns positions (V, 3) in m and the report, a dict. Raises NotConverged or Unstable with what was "
             "reached as `positions` and `report`.");
  module.def("probe", &probe, "material"_a, "F"_a, "dF"_a = nb::none(),
             "Evaluates a law at deformation gradients F (n, 3, 3): a dict of W (n,) in J/m³, P (n, 3, 3), the first "
             "Piola-Kirchhoff stress in Pa, and, where dF (n, 3, 3) is given, dP = ∂P/∂F : dF (n, 3, 3) in Pa. "
             "material: an entry of a scene's `materials`; of active stress and rate effects, which have no part, a "
             "warning tells. NaN where the law is not defined.");
}

}  // namespace heml::python
