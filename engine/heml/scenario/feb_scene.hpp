#pragma once
// Scenes from FEBio files (.feb, format 2.5, 3.0, 4.0):
//
//   Geometry, Mesh        tet4; tet10 as p2; hex8, penta6, pyra5 divided, as p2;
//                         parts become regions with their names                           mesh/feb_mesh.hpp
//   Material, MeshDomains a material for each region                                      feb_material.hpp
//   Control               static, or dynamic with its step and duration
//   LoadData              ramps                                                           feb_curve.hpp
//   Boundary              nodes held or moved                                             feb_boundary.cpp
//   Loads                 forces, tractions, pressures, gravity                           feb_loads.cpp
//   Contact               sliding contacts become self-contact
//
// What would change the result is refused, all of it in one message; what does not is told as warnings.
#include <heml/scenario/scene.hpp>

namespace heml {

/// Whether a file is FEBio's, by its ending.
bool is_feb_file(const std::filesystem::path& path);

/// The scene of a file, whose mesh stays the file. Units: of options.unit with newtons and seconds, else of the file's
/// <units>, else SI. Throws InputError.
Scene scene_from_feb(const std::filesystem::path& path, const BareMeshOptions& options = {});

}  // namespace heml
