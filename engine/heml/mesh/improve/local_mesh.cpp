#include <algorithm>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/improve/local_mesh.hpp>

namespace heml {
namespace {

bool contains(const Tet& tet, int node) { return std::find(tet.begin(), tet.end(), node) != tet.end(); }

/// The other nodes r, s of an element with edge ab, such that (a, b, r, s) has the element's orientation.
std::array<int, 2> opposite_edge(const Tet& tet, int a, int b) {
  for (int f = 0; f < 4; ++f)
    for (std::size_t k = 0; k < 3; ++k) {  // face (b, r, s) lies opposite a, outward: (a, b, r, s) is positive
      const auto& face = tet_faces[f];
      if (tet[f] == a && tet[face[k]] == b) return {tet[face[(k + 1) % 3]], tet[face[(k + 2) % 3]]};
    }
  return {-1, -1};
}

}  // namespace

LocalMesh::LocalMesh(const TetMesh& mesh, const ShapeMeasure& measure)
    : nodes_(mesh.nodes), on_surface_(mesh.nodes.size(), 0), stars_(mesh.nodes.size()), measure_(measure) {
  tets_.reserve(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const RegionTet tet{mesh.tets[t], mesh.regions[t]};
    replace({}, {&tet, 1});
  }
  for (int t = 0; t < slots(); ++t)
    for (int f = 0; f < 4; ++f)
      if (is_constrained(t, f))
        for (const int local : tet_faces[f]) on_surface_[tets_[t][local]] = 1;
}

void LocalMesh::set_measure(const ShapeMeasure& measure) {
  measure_ = measure;
  for (int t = 0; t < slots(); ++t)
    if (exists(t)) qualities_[t] = quality_of(tets_[t]);
}

Corners LocalMesh::corners(const Tet& tet) const {
  return {nodes_[tet[0]], nodes_[tet[1]], nodes_[tet[2]], nodes_[tet[3]]};
}

double LocalMesh::worst(std::span<const int> tets) const {
  double worst = 1;
  for (const int t : tets) worst = std::min(worst, qualities_[t]);
  return worst;
}

int LocalMesh::across(int t, int face) const {
  const Tet& tet = tets_[t];
  const auto& [a, b, c] = tet_faces[face];
  for (const int other : stars_[tet[a]])
    if (other != t && contains(tets_[other], tet[b]) && contains(tets_[other], tet[c])) return other;
  return -1;
}

bool LocalMesh::is_constrained(int t, int face) const {
  const int other = across(t, face);
  return other < 0 || regions_[other] != regions_[t];
}

std::vector<Triangle> LocalMesh::surface_faces(int n) const {
  std::vector<Triangle> faces;
  if (!on_surface_[n]) return faces;
  for (const int t : stars_[n])
    for (int f = 0; f < 4; ++f) {
      const Tet& tet = tets_[t];
      const auto& face = tet_faces[f];
      if (tet[f] == n || !on_surface_[tet[face[0]]] || !on_surface_[tet[face[1]]] || !on_surface_[tet[face[2]]])
        continue;
      const int other = across(t, f);
      if (other >= 0 && regions_[other] <= regions_[t]) continue;
      Triangle nodes{tet[face[0]], tet[face[1]], tet[face[2]]};
      std::rotate(nodes.begin(), std::find(nodes.begin(), nodes.end(), n), nodes.end());
      faces.push_back(nodes);
    }
  return faces;
}

bool LocalMesh::has_edge(int a, int b) const {
  return std::any_of(stars_[a].begin(), stars_[a].end(), [&](int t) { return contains(tets_[t], b); });
}

std::vector<RingSector> LocalMesh::ring(int a, int b) const {
  struct Link {
    int from, to, tet;
    bool is_used;
  };
  std::vector<Link> links;
  for (const int t : stars_[a])
    if (contains(tets_[t], b)) {
      const auto [from, to] = opposite_edge(tets_[t], a, b);
      links.push_back({from, to, t, false});
    }
  const auto predecessor = [&](const Link& link) {
    return std::find_if(links.begin(), links.end(), [&](const Link& other) { return other.to == link.from; });
  };
  const auto starts_sector = [&](const Link& link) {
    const auto before = predecessor(link);
    return before == links.end() || regions_[before->tet] != regions_[link.tet];
  };
  std::vector<RingSector> sectors;
  const auto follow = [&](Link* link, bool is_closed) {
    RingSector sector;
    sector.is_closed = is_closed;
    sector.nodes.push_back(link->from);
    while (link && !link->is_used && (sector.tets.empty() || !starts_sector(*link))) {
      link->is_used = true;
      sector.tets.push_back(link->tet);
      sector.nodes.push_back(link->to);
      const auto next =
          std::find_if(links.begin(), links.end(), [&](const Link& other) { return other.from == link->to; });
      link = next == links.end() ? nullptr : &*next;
    }
    if (is_closed) sector.nodes.pop_back();
    sectors.push_back(std::move(sector));
  };
  for (Link& link : links)
    if (!link.is_used && starts_sector(link)) follow(&link, false);
  if (sectors.empty() && !links.empty()) follow(&links.front(), true);
  const bool all = std::all_of(links.begin(), links.end(), [](const Link& link) { return link.is_used; });
  return all ? sectors : std::vector<RingSector>();
}

void LocalMesh::replace(std::span<const int> removed, std::span<const RegionTet> added) {
  for (const int t : removed) {
    for (const int n : tets_[t]) std::erase(stars_[n], t);
    changed_.insert(changed_.end(), tets_[t].begin(), tets_[t].end());
    tets_[t] = {-1, -1, -1, -1};
    free_.push_back(t);
  }
  for (const RegionTet& tet : added) {
    int t = slots();
    if (free_.empty()) {
      tets_.push_back(tet.nodes);
      regions_.push_back(tet.region);
      qualities_.push_back(0);
    } else {
      t = free_.back();
      free_.pop_back();
      tets_[t] = tet.nodes;
      regions_[t] = tet.region;
    }
    qualities_[t] = quality_of(tet.nodes);
    for (const int n : tet.nodes) stars_[n].push_back(t);
    changed_.insert(changed_.end(), tet.nodes.begin(), tet.nodes.end());
  }
  count_ += static_cast<int>(added.size()) - static_cast<int>(removed.size());
}

void LocalMesh::move(int n, const Vec3& x) {
  nodes_[n] = x;
  for (const int t : stars_[n]) {
    qualities_[t] = quality_of(tets_[t]);
    changed_.insert(changed_.end(), tets_[t].begin(), tets_[t].end());
  }
}

int LocalMesh::add_node(const Vec3& x, bool is_on_surface) {
  nodes_.push_back(x);
  on_surface_.push_back(is_on_surface);
  stars_.emplace_back();
  return nodes() - 1;
}

void LocalMesh::remove_last_node() {
  nodes_.pop_back();
  on_surface_.pop_back();
  stars_.pop_back();
}

TetMesh LocalMesh::extract(const std::string& source) const {
  TetMesh mesh;
  mesh.source = source;
  std::vector<int> number(nodes_.size(), -1);
  for (int n = 0; n < nodes(); ++n)
    if (!stars_[n].empty()) {
      number[n] = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(nodes_[n]);
    }
  for (int t = 0; t < slots(); ++t)
    if (exists(t)) {
      const Tet& tet = tets_[t];
      mesh.tets.push_back({number[tet[0]], number[tet[1]], number[tet[2]], number[tet[3]]});
      mesh.regions.push_back(regions_[t]);
    }
  return mesh;
}

std::vector<int> elements_of(const std::vector<RingSector>& sectors) {
  std::vector<int> tets;
  for (const RingSector& sector : sectors) tets.insert(tets.end(), sector.tets.begin(), sector.tets.end());
  return tets;
}

}  // namespace heml
