#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <heml/mesh/connected_parts.hpp>
#include <heml/world/rigid_motions.hpp>
#include <map>

namespace heml {
namespace {

Vec3 at(const Vector& x, int node) { return x.segment<3>(3 * node); }

}  // namespace

RigidMotions::RigidMotions(const TetMesh& mesh, const MidEdges& midedges, Vector mass) : mass_(std::move(mass)) {
  std::map<int, std::vector<int>> parts;
  const std::vector<int> part = connected_parts(mesh, midedges);
  for (std::size_t n = 0; n < part.size(); ++n) parts[part[n]].push_back(static_cast<int>(n));
  const auto is_free = [&](int n) { return mass_.segment<3>(3 * n).minCoeff() > 0; };
  for (auto& [first, nodes] : parts)
    if (nodes.size() >= 4 && std::all_of(nodes.begin(), nodes.end(), is_free)) parts_.push_back(std::move(nodes));
}

Vec3 RigidMotions::centre(const std::vector<int>& part, const Vector& x) const {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (const int n : part) {
    sum += mass_[3 * n] * at(x, n);
    mass += mass_[3 * n];
  }
  return sum / mass;
}

Vector RigidMotions::velocity(const Vector& x, const Vector& v) const {
  Vector result = Vector::Zero(v.size());
  for (const std::vector<int>& part : parts_) {
    const Vec3 middle = centre(part, x), mean = centre(part, v);
    Mat3 inertia = Mat3::Zero();
    Vec3 momentum = Vec3::Zero();
    for (const int n : part) {
      const Vec3 r = at(x, n) - middle;
      inertia += mass_[3 * n] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
      momentum += mass_[3 * n] * r.cross(Vec3(at(v, n) - mean));
    }
    Vec3 spin = inertia.fullPivLu().solve(momentum);
    if (!spin.allFinite()) spin.setZero();
    for (const int n : part) result.segment<3>(3 * n) = mean + spin.cross(Vec3(at(x, n) - middle));
  }
  return result;
}

Vector RigidMotions::moved(const Vector& from, const Vector& to) const {
  Vector result = from;
  for (const std::vector<int>& part : parts_) {
    const Vec3 old = centre(part, from), now = centre(part, to);
    Mat3 H = Mat3::Zero();
    for (const int n : part) H += mass_[3 * n] * (at(to, n) - now) * (at(from, n) - old).transpose();
    const Eigen::JacobiSVD<Mat3> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
    const Mat3 turn = U * svd.matrixV().transpose();
    for (const int n : part) result.segment<3>(3 * n) = now + turn * (at(from, n) - old);
  }
  return result;
}

Vector RigidMotions::slid(const Vector& from, const Vector& to, const Vector& forces) const {
  Vector result = from;
  for (const std::vector<int>& part : parts_) {
    Vec3 force = Vec3::Zero();
    for (const int n : part) force += at(forces, n);
    Vec3 way = centre(part, to) - centre(part, from);
    if (const double square = force.squaredNorm(); square > 0) way -= force.dot(way) / square * force;
    for (const int n : part) result.segment<3>(3 * n) += way;
  }
  return result;
}

}  // namespace heml
