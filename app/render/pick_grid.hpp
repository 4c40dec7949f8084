#pragma once
// Picks of one picture, many at once: pick() for the triangles alone that the picture shows near a pixel.
//
//   ┌──┬──┬──┐
//   ├──┼─▲┼──┤   cells of the picture, of about a triangle each; a triangle is listed in each cell that its corners
//   └──┴──┴──┘   span; those that reach behind the eye are tried at every pixel
#include <app/render/pick.hpp>

namespace heml::render {

class PickGrid {
 public:
  /// camera, size: of the picture. Frame and surface outlive it.
  PickGrid(const Frame& frame, const SurfaceMesh& surface_mesh, const Camera& camera, Size size);

  /// What pick() finds for the ray through a pixel of the picture.
  std::optional<Hit> pick(const Vec2f& at, const std::optional<SectionPlane>& section = std::nullopt) const;

 private:
  int column(float x) const;
  int row(float y) const;
  void list_triangles(const std::vector<bool>& behind);
  template <class Visit>
  void each_cell(const Triangle& triangle, const Visit& visit) const;

  const Frame& frame_;
  const SurfaceMesh& surface_mesh_;
  Camera camera_;
  Size size_;
  int columns_ = 1, rows_ = 1;
  float side_ = 1;                   // pixels, of a cell
  std::vector<Vec2f> pixels_;        // of the nodes; not finite behind the eye
  std::vector<std::size_t> starts_;  // in triangles_, of each cell, row by row, and the end
  std::vector<int> triangles_;       // ascending in each cell
  std::vector<int> everywhere_;      // ascending
};

}  // namespace heml::render
