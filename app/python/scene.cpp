// heml.Scene
#include <nanobind/stl/string.h>

#include <app/python/bindings.hpp>
#include <app/python/json_objects.hpp>
#include <app/python/paths.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/installed_scene.hpp>

namespace heml::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

constexpr const char* dict_name = "scene";  // of a dict, in messages

nb::object to_dict(const Scene& scene) { return object_from(parse_json(scene_text(scene), scene.file)); }

void save(const Scene& scene, nb::object path) {
  const std::filesystem::path file = path_text(path);
  std::vector<std::filesystem::path> inputs = input_files(scene);
  if (std::filesystem::path(scene.file).extension() == ".json") inputs.erase(inputs.begin());  // may be saved again
  refuse_overwriting(inputs, {file}, "path");
  write_file(file, scene_text(scene, std::filesystem::absolute(file).parent_path()));
}

nb::tuple pickled_scene(const Scene& scene) { return nb::make_tuple(recording_text(scene), path_object(scene.file)); }

void unpickle_scene(Scene& scene, const nb::tuple& state) {
  if (nb::len(state) != 2) throw nb::value_error("no state of a heml.Scene");
  new (&scene) Scene(parse_scene(nb::cast<std::string>(state[0]), path_text(state[1])));
}

}  // namespace

Scene scene_from(nb::handle given) {
  if (nb::isinstance<Scene>(given)) return nb::cast<const Scene&>(given);
  if (nb::isinstance<nb::dict>(given)) return parse_scene(json_text(json_from(given, dict_name), dict_name), dict_name);
  return read_scene(scene_path(path_text(given)));
}

void bind_scene(nb::module_& module) {
  nb::class_<Scene>(module, "Scene",
                    "A scene: mesh, materials, supports, loads, solver, events. Made from a file (scene, recording, "
                    "mesh or surface), the name of an installed scene (\"cantilever\"), or a dict as in scene files; "
                    "paths in a dict are relative to the working directory. Can be pickled.")
      .def(
          "__init__", [](Scene* self, nb::object path_or_dict) { new (self) Scene(scene_from(path_or_dict)); },
          "path_or_dict"_a, "Throws InputError for what is wrong, naming the key.",
          nb::sig("def __init__(self, path_or_dict: str | os.PathLike | dict | Scene) -> None"))
      .def("to_dict", &to_dict, "The scene as a dict that Scene() takes. Its paths are absolute.",
           nb::sig("def to_dict(self) -> dict"))
      .def("save", &save, "path"_a, "Writes a scene file; paths in it are relative to it where they lie below it.",
           nb::sig("def save(self, path: str | os.PathLike) -> None"))
      .def_prop_ro(
          "file", [](const Scene& scene) { return path_object(scene.file); }, "Path it was read from.",
          nb::sig("def file(self) -> str"))
      .def_prop_ro("name", [](const Scene& scene) { return scene.name; })
      .def_prop_ro(
          "tick", [](const Scene& scene) { return scene.solver.tick(); }, "Length of a tick, s.")
      .def_prop_ro(
          "duration", [](const Scene& scene) { return scene.solver.duration; }, "solver.duration, s.")
      .def("__getstate__", &pickled_scene)
      .def("__setstate__", &unpickle_scene)
      .def("__repr__", [](const Scene& scene) { return nb::str("heml.Scene({!r})").format(path_object(scene.file)); });
}

}  // namespace heml::python
