#include "improve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace heml::make {

double Quality::operator()(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) const {
  const Vec3 x[4] = {x0, x1, x2, x3};
  const double volume = signed_volume(x0, x1, x2, x3);
  const auto area = [&](int a, int b, int c) { return 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm(); };
  const double opposite[4] = {area(1, 2, 3), area(0, 2, 3), area(0, 1, 3), area(0, 1, 2)};
  double least = 3 * volume / (*std::max_element(opposite, opposite + 4) * edge);
  // sin θ = 3/2 · V · length / (product of the two faces that meet there)
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) {
      int c = 0;
      while (c == a || c == b) ++c;
      const int d = 6 - a - b - c;
      least = std::min(least, 1.5 * volume * (x[a] - x[b]).norm() / (opposite[c] * opposite[d]));
    }
  return least;
}

int smooth(TetMesh& mesh, const Quality& quality, const Constraint& constraint, double enough, int rounds) {
  std::vector<std::vector<int>> star(mesh.nodes.size());
  for (int t = 0; t < int(mesh.tets.size()); ++t)
    for (const int n : mesh.tets[t]) star[n].push_back(t);

  const auto worst_round = [&](int n) {
    double worst = std::numeric_limits<double>::infinity();
    for (const int t : star[n]) {
      const Tet& k = mesh.tets[t];
      worst = std::min(worst, quality(mesh.nodes[k[0]], mesh.nodes[k[1]], mesh.nodes[k[2]], mesh.nodes[k[3]]));
    }
    return worst;
  };
  const auto shortest_edge = [&](int n) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const int t : star[n])
      for (const int m : mesh.tets[t])
        if (m != n) shortest = std::min(shortest, (mesh.nodes[m] - mesh.nodes[n]).norm());
    return shortest;
  };
  int moves = 0;
  for (int round = 0; round < rounds; ++round)
    for (int n = 0; n < int(mesh.nodes.size()); ++n) {
      double best = worst_round(n);
      if (best > enough) continue;
      const double length = shortest_edge(n);
      for (double reach = 0.3 * length; reach > 0.02 * length; reach *= 0.5)
        for (int direction = 0; direction < 27; ++direction) {
          const Vec3 step(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
          const Vec3 before = mesh.nodes[n];
          mesh.nodes[n] = constraint(n, before + reach * step);
          if (const double now = worst_round(n); now > best + 1e-3) {
            best = now;
            ++moves;
          } else {
            mesh.nodes[n] = before;
          }
        }
    }
  return moves;
}

}  // namespace heml::make
