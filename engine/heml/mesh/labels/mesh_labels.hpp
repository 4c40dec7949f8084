#pragma once
// Label maps to tetrahedra.
//
//   specks removed      clean_labels.hpp
//   labels smoothed     label_field.hpp
//   lattice             lattice.hpp: its cells as large as gives the wanted number
//   cut at interfaces   cut_lattice.hpp; weights of the labels such that each has the volume of its voxels
//   shapes improved     improve/improve.hpp
#include <functional>
#include <heml/mesh/labels/label_map.hpp>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

struct LabelMeshOptions {
  int tets = 20000;       ///< wanted, met within a quarter
  double min_angle = 10;  ///< degrees, dihedral, wanted of every element
  std::function<void(double fraction, const char* doing)> progress = {};  ///< none: quiet
};

struct LabelMeshing {
  struct Label {
    int value = 0;            ///< in the file, the region of its elements
    double voxel_volume = 0;  ///< m³, of its voxels without specks
    double mesh_volume = 0;   ///< m³
  };
  TetMesh mesh;  ///< regions: the file's numbers; metres, x right, y anterior, z superior
  std::vector<Label> labels;
  double cell = 0;         ///< m, side of the lattice's finest cells; elements on interfaces are about as long
  std::vector<int> below;  ///< elements that miss the wanted angle, the worst first
};

/// Deterministic. Warns of specks, of labels that the elements are too coarse for, and of volumes off by more than 1 %.
/// Throws InputError.
LabelMeshing mesh_labels(LabelMap map, const LabelMeshOptions& options = {});

}  // namespace heml
