// The extension module heml._core. The package heml/ gives its names to users.
#include <app/python/bindings.hpp>
#include <app/python/errors.hpp>
#include <heml/scenario/build_identity.hpp>

NB_MODULE(_core, module) {
  namespace python = heml::python;
  module.doc() = "Interactive real-time simulation of hyperelastic soft tissue. SI units.";
  module.attr("__version__") = HEML_VERSION;
  module.attr("build") = heml::build_name().c_str();
  module.attr("kernel_revision") = heml::kernel_revision;
  python::bind_errors(module);
  python::bind_scene(module);
  python::bind_snapshot(module);
  python::bind_world(module);
  python::bind_solve(module);
  python::bind_batch(module);
  python::bind_render(module);
}
