// TetGen: H. Si, TetGen, a Delaunay-based quality tetrahedral mesh generator, ACM TOMS 41 (2015).
#include <tetgen.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>

#include "exchange.hpp"

namespace mesher {
namespace {

// Maps to the unit cube and back, since TetGen's tolerances are absolute.
struct Frame {
  std::array<double, 3> centre;
  double size = 0;

  explicit Frame(const std::vector<double>& nodes) {
    for (int i = 0; i < 3; ++i) {
      double low = nodes[i], high = nodes[i];
      for (std::size_t n = i; n < nodes.size(); n += 3) {
        low = std::min(low, nodes[n]);
        high = std::max(high, nodes[n]);
      }
      centre[i] = (low + high) / 2;
      size = std::max(size, high - low);
    }
  }
  void to_unit(const std::vector<double>& from, double* to) const {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = (from[i] - centre[i % 3]) / size;
  }
  double from_unit(double value, std::size_t i) const { return value * size + centre[i % 3]; }
};

// Allocates with new[], since tetgenio frees its arrays with delete[].
void give(const Exchange& surface, const Frame& frame, tetgenio& in) {
  in.numberofpoints = static_cast<int>(surface.nodes.size() / 3);
  in.pointlist = new double[surface.nodes.size()];
  frame.to_unit(surface.nodes, in.pointlist);
  in.numberofholes = static_cast<int>(surface.holes.size() / 3);
  if (in.numberofholes > 0) {
    in.holelist = new double[surface.holes.size()];
    frame.to_unit(surface.holes, in.holelist);
  }
  in.numberoffacets = static_cast<int>(surface.rows.size() / 3);
  in.facetlist = new tetgenio::facet[in.numberoffacets];
  for (int f = 0; f < in.numberoffacets; ++f) {
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::polygon& polygon = facet.polygonlist[0];
    polygon.numberofvertices = 3;
    polygon.vertexlist = new int[3];
    for (int i = 0; i < 3; ++i) polygon.vertexlist[i] = surface.rows[3 * f + i];
  }
}

const char* reason(int code) {
  switch (code) {
    case 3:
      return "TetGen finds that the surface runs through itself";
    case 4:
      return "TetGen finds details too small for it";
    case 5:
      return "TetGen finds triangles too close to each other";
    default:
      return "TetGen cannot fill this surface";
  }
}

}  // namespace

Exchange fill_surface(const Exchange& surface, double radius_edge_ratio, double max_volume) {
  const Frame frame(surface.nodes);
  tetgenio in, out;
  give(surface, frame, in);
  // p: fill a surface; Y: keep its triangles; q: radius-edge ratio; a: maximum volume; Q: quiet.
  char switches[128];
  if (max_volume > 0)
    std::snprintf(switches, sizeof switches, "pYq%.9ga%.17gQ", radius_edge_ratio,
                  max_volume / (frame.size * frame.size * frame.size));
  else
    std::snprintf(switches, sizeof switches, "pYq%.9gQ", radius_edge_ratio);
  try {
    tetrahedralize(switches, &in, &out);
  } catch (int code) {
    if (code == 1) throw std::bad_alloc();
    throw Failure(reason(code));
  }
  if (out.numberoftetrahedra == 0) throw Failure("TetGen filled nothing");
  Exchange tets;
  for (int i = 0; i < 3 * out.numberofpoints; ++i) tets.nodes.push_back(frame.from_unit(out.pointlist[i], i));
  tets.rows.assign(out.tetrahedronlist, out.tetrahedronlist + 4 * static_cast<std::size_t>(out.numberoftetrahedra));
  return tets;
}

}  // namespace mesher
