#pragma once
// Reads arbitrary bytes as a mesh file of a given format, for fuzzing.
#include <algorithm>
#include <array>
#include <heml/base/error.hpp>
#include <heml/mesh/check_ply.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/readers.hpp>
#include <string_view>

namespace heml {

inline constexpr std::array formats{"msh", "mesh", "vtk", "vtu", "tetgen", "ply", "inp", "feb"};

/// Reads a text as formats[format] and checks the mesh; for PLY, only the sizes it declares. TetGen's two files are
/// separated by a zero byte. Returns true for a valid mesh and false for an InputError; other exceptions propagate.
inline bool read_and_check(std::size_t format, std::string_view text) {
  try {
    ReadMesh read;
    const std::size_t zero = std::min(text.find('\0'), text.size());
    switch (format) {
      case 0:
        read = read_gmsh("fuzz", text);
        break;
      case 1:
        read = read_medit("fuzz", text);
        break;
      case 2:
        read = read_vtk("fuzz", text);
        break;
      case 3:
        read = read_vtu("fuzz", text);
        break;
      case 5:
        check_ply("fuzz.ply", text);
        return true;
      case 6:
        read = read_abaqus("fuzz", text);
        break;
      case 7:
        read = read_feb("fuzz", text);
        break;
      default:
        read = read_tetgen("fuzz.node", text.substr(0, zero), "fuzz.ele", text.substr(std::min(zero + 1, text.size())));
    }
    check_tets(read.mesh);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace heml
