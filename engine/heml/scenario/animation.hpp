#pragma once
// A body over time, for files that hold a whole animation.
#include <heml/mesh/tet_mesh.hpp>
#include <heml/world/world.hpp>
#include <vector>

namespace heml {

/// The boundary of a world's present elements.
struct WorldSurface {
  std::vector<int> nodes;           ///< #N, of the mesh, in order of appearance in the triangles
  std::vector<Triangle> triangles;  ///< #F×3, indices of `nodes`, outward
  std::vector<int> tets;            ///< #F, the tetrahedron behind each, among the present ones
};
WorldSurface surface_of(World& world);

/// Frames between two edits of the mesh: the elements stay, the nodes move.
struct AnimationPart {
  WorldSurface surface;
  std::vector<int> regions;                   ///< #F, of the tetrahedron behind
  std::vector<Tet> tets;                      ///< #E, the present ones; empty without the inside
  std::vector<int> tet_regions;               ///< #E
  std::vector<double> times;                  ///< #T, s, ascending
  std::vector<std::vector<Vec3f>> positions;  ///< #T×#N of the surface's nodes, or with the inside of all, m
};

class Animation {
 public:
  enum class Extent { surface, body };

  /// file: where it will be written, for messages. extent: whether the inside is kept too.
  Animation(std::string file, Extent extent) : file_(std::move(file)), extent_(extent) {}

  /// Adds the present state. Cuts, tears and other edits begin a new part. Throws InputError beyond 1 GB.
  void add_frame(World& world);

  const std::vector<AnimationPart>& parts() const { return parts_; }
  int taken() const { return taken_; }

 private:
  void begin_part(World& world);

  std::string file_;
  Extent extent_;
  std::vector<AnimationPart> parts_;
  std::size_t bytes_ = 0;
  long version_ = 0;  ///< of the topology of the last part
  int taken_ = 0;
};

}  // namespace heml
