// mesh_seeds FOLDER: writes the hand-written samples as seeds for mesh_fuzz, each preceded by its format byte.
#include <filesystem>
#include <fstream>

#include "engine/mesh/binary_samples.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  using namespace heml::samples;
  const auto write = [&](const char* name, char format, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << format << text;
  };
  write("gmsh_1", 0, gmsh_1);
  write("gmsh_2", 0, gmsh_2);
  write("gmsh_4", 0, gmsh_4);
  write("gmsh_2_data", 0, gmsh_2_data);
  write("gmsh_4_data", 0, gmsh_4_data);
  write("gmsh_4_binary", 0, gmsh_4_binary(true));
  write("gmsh_2_binary", 0, gmsh_2_binary());
  write("medit", 1, medit);
  write("vtk", 2, vtk);
  write("vtk_5", 2, vtk_5);
  write("vtk_binary", 2, vtk_binary);
  write("vtk_5_binary", 2, vtk_5_binary);
  write("vtu", 3, vtu);
  write("vtu_base64", 3, vtu_base64);
  write("vtu_compressed", 3, vtu_compressed);
  write("vtu_raw", 3, vtu_raw);
  write("vtu_raw_compressed", 3, vtu_raw_compressed);
  write("tetgen", 4, node + '\0' + ele);
  write("tetgen_attributes", 4, node + '\0' + ele_attributes);
  write("ply", 5, ply);
  write("ply_little_endian", 5, ply_little_endian);
  write("ply_big_endian", 5, ply_big_endian);
  write("abaqus", 6, abaqus);
  write("feb", 7, feb);
}
