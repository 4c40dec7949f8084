#include "fill.hpp"

#include <tetgen.h>

#include <stdexcept>

namespace heml::make {
namespace {

void set_points(tetgenio& io, const std::vector<Vec3>& points) {
  io.firstnumber = 0;
  io.numberofpoints = int(points.size());
  io.pointlist = new REAL[points.size() * 3];
  for (std::size_t n = 0; n < points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis) io.pointlist[3 * n + axis] = points[n][axis];
}

void set_facets(tetgenio& io, const std::vector<Triangle>& triangles) {
  io.numberoffacets = int(triangles.size());
  io.facetlist = new tetgenio::facet[triangles.size()];
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    tetgenio::facet& facet = io.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(&facet.polygonlist[0]);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3]{triangles[f][0], triangles[f][1], triangles[f][2]};
  }
}

TetMesh run(const char* switches, tetgenio& in, std::size_t points) {
  std::string text = switches;
  tetgenio out;
  tetrahedralize(text.data(), &in, &out);
  if (out.numberoftetrahedra == 0) throw std::runtime_error("TetGen made no tetrahedra");
  if (std::size_t(out.numberofpoints) != points) throw std::runtime_error("TetGen added or dropped points");
  TetMesh mesh;
  for (int n = 0; n < out.numberofpoints; ++n) mesh.nodes.emplace_back(Eigen::Map<const Vec3>(out.pointlist + 3 * n));
  for (int t = 0; t < out.numberoftetrahedra; ++t) {
    const int* tet = out.tetrahedronlist + 4 * t;

    mesh.tets.push_back({tet[0], tet[1], tet[2], tet[3]});
  }
  mesh.regions.assign(mesh.tets.size(), 1);
  return mesh;
}

}  // namespace

std::vector<Vec3> interior_lattice(const Shape& shape, const Vec3& low, const Vec3& high, double depth,
                                   double spacing) {
  std::vector<Vec3> points;
  const Eigen::Vector3i count = ((high - low) / spacing).array().ceil().cast<int>();
  for (int z = 0; z < 2 * count.z(); ++z)
    for (int y = 0; y < 2 * count.y(); ++y)
      for (int x = 0; x < 2 * count.x(); ++x) {
        if ((x ^ y) & 1 || (y ^ z) & 1) continue;  // corners of the cells, and their centres
        const Vec3 p = low + 0.5 * spacing * Vec3(x, y, z);
        if (shape(p) < -depth) points.push_back(p);
      }
  return points;
}

TetMesh fill(const TriangleMesh& surface, const std::vector<Vec3>& interior) {
  tetgenio in;
  std::vector<Vec3> points = surface.nodes;
  points.insert(points.end(), interior.begin(), interior.end());
  set_points(in, points);
  set_facets(in, surface.triangles);
  return run("pYO7/7o/150Q", in, points.size());
}

TetMesh delaunay(const std::vector<Vec3>& points) {
  tetgenio in;
  set_points(in, points);
  return run("Q", in, points.size());
}

}  // namespace heml::make
