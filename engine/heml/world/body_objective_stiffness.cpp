// The stiffness of a body with all that acts on it: products, and assembly into matrices.
#include <heml/elastic/bsr_matrix.hpp>
#include <heml/world/body_objective.hpp>

namespace heml {
namespace {

Mat3 cross_matrix(const Vec3& w) {
  Mat3 result;
  result << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return result;
}

Vec3 place_of(const Vector& x, int node) { return x.segment<3>(3 * node); }

}  // namespace

/// Pressure pushes each node of a face by q = p (b−a)×(c−a), p a sixth of the pressure inward, so that
/// ∂q/∂x_j = p [w_j]×, w the opposite edges. Calls visit(face, p, w).
template <class Real>
template <class Visit>
void BodyObjective<Real>::each_pressed_face(const Vector& x, const Visit& visit) const {
  if (x.size() == 0) return;
  for (const auto& load : model_->pressures) {
    const double p = -static_cast<double>(load.pascal) * load.ramp(time_) / 6;
    for (const Triangle& face : load.faces) {
      const Vec3 a = place_of(x, face[0]), b = place_of(x, face[1]), c = place_of(x, face[2]);
      visit(face, p, std::array<Vec3, 3>{c - b, a - c, b - a});
    }
  }
}

/// The same at the integration points of six-node faces, whose virtual corners are a, b, c: node k takes N_k of q.
template <class Real>
template <class Visit>
void BodyObjective<Real>::each_pressed_point(const Vector& x, const Visit& visit) const {
  if (x.size() == 0) return;
  for (const auto& load : model_->pressures) {
    const double p = -static_cast<double>(load.pascal) * load.ramp(time_) / 2;
    for (const std::array<int, 6>& nodes : load.quadratic_faces)
      for (const FacePoint& point : face_points) {
        const auto [a, b, c] = virtual_face(point, [&](std::size_t k) { return place_of(x, nodes[k]); });
        visit(nodes, point, p * point.weight, std::array<Vec3, 3>{c - b, a - c, b - a});
      }
  }
}

template <class Real>
void BodyObjective<Real>::linearise(const Vector& x, Projection projection) {
  if (is_refined()) {
    double_body_->linearise(x.data(), team_);
  } else {
    const Real* at_x = as_real(x, x_);
    const FlowTrial trial(body_, at_x, team_, flow_lags_);
    body_.linearise(at_x, team_);
  }
  with_body([&](auto& body) { body.project(projection, team_); });
  const bool with_pressure = !model_->pressures.empty() && projection == Projection::none;
  linearisation_point_ = with_pressure ? x : Vector();
  if (!contact_.empty()) contact_.linearise(x, projection != Projection::none);
}

template <class Real>
void BodyObjective<Real>::product(const Vector& dx, Vector& out) {
  change_.resize(dx.size());
  if (is_refined()) {
    double_body_->force_differential(dx.data(), change_.data(), team_);
  } else {
    const Real* along = as_real(dx, dx_);
    f_.resize(dx_.size());
    body_.force_differential(along, f_.data(), team_);
    for (std::size_t i = 0; i < f_.size(); ++i) change_[static_cast<Eigen::Index>(i)] = static_cast<double>(f_[i]);
  }
  out.setZero(dx.size());
  for (const int n : free_.node) {
    const double a = regularisation_ * static_cast<double>(masses_->lumped[static_cast<std::size_t>(n)]);
    for (int i = 0; i < 3; ++i) out[3 * n + i] = -change_[3 * n + i] + a * dx[3 * n + i];
  }
  const auto add = [&](int n, const Vec3& force) {
    if (free_.number[static_cast<std::size_t>(n)] >= 0) out.segment<3>(3 * n) += force;
  };
  each_pressed_face(linearisation_point_, [&](const Triangle& face, double p, const std::array<Vec3, 3>& w) {
    Vec3 push = Vec3::Zero();
    for (std::size_t j = 0; j < 3; ++j) push += p * w[j].cross(place_of(dx, face[j]));
    for (const int n : face) add(n, -push);
  });
  each_pressed_point(linearisation_point_, [&](const std::array<int, 6>& nodes, const FacePoint& point, double p,
                                               const std::array<Vec3, 3>& w) {
    const auto moved = virtual_face(point, [&](std::size_t k) { return place_of(dx, nodes[k]); });
    Vec3 push = Vec3::Zero();
    for (std::size_t j = 0; j < 3; ++j) push += p * w[j].cross(moved[j]);
    for (std::size_t k = 0; k < 6; ++k) add(nodes[k], -point.N[k] * push);
  });
  if (!contact_.empty()) {
    contact_.add_product(dx, out);
    for (std::size_t n = 0; n < free_.number.size(); ++n)
      if (free_.number[n] < 0) out.segment<3>(3 * static_cast<int>(n)).setZero();
  }
  for (const auto& grasp : grasps_)
    grasp.each_stiffness([&](int n, Real k, Real damping) {
      add(n, (static_cast<double>(k) + (d_ > 0 ? static_cast<double>(damping) / d_ : 0)) * place_of(dx, n));
    });
  free_.clear_held(out);
}

template <class Real>
void BodyObjective<Real>::add_stiffness(BlockMatrix& matrix) {
  with_body([&](auto& body) {
    body.each_stiffness([&](const auto& nodes, const auto& K) {
      matrix.add_element(nodes, [&](int row, int column) {
        return static_cast<double>(K[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]);
      });
    });
    body.each_spring_stiffness([&](int a, int b, const auto& block) {
      Mat3 B;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) B(i, j) = static_cast<double>(block[i][j]);
      matrix.add_node(a, B);
      matrix.add_node(b, B);
      matrix.add_pair(a, b, -B);
    });
  });
  // Of −p [w_j]× in row i: p/2 ([w_i]× − [w_j]×).
  each_pressed_face(linearisation_point_, [&](const Triangle& face, double p, const std::array<Vec3, 3>& w) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      matrix.add_pair(face[i], face[j], p / 2 * cross_matrix(w[i] - w[j]));
    }
  });
  each_pressed_point(linearisation_point_, [&](const std::array<int, 6>& nodes, const FacePoint& point, double p,
                                               const std::array<Vec3, 3>& w) {
    const auto along = [&](std::size_t k) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t j = 0; j < 3; ++j) sum += point.slope[j][k] * w[j];
      return sum;
    };
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < i; ++j)
        matrix.add_pair(nodes[i], nodes[j], -p / 2 * cross_matrix(point.N[i] * along(j) - point.N[j] * along(i)));
  });
  add_contact_stiffness(matrix);
  add_diagonal(matrix);
}

template <class Real>
bool BodyObjective<Real>::assemble_single_precision(BsrMatrix& rows) {
  if (!is_symmetric()) return false;
  if (!with_body([&](const auto& body) { return body.assemble(rows, team_); })) return false;
  add_diagonal(rows);
  return true;
}

template <class Real>
template <class Matrix>
void BodyObjective<Real>::add_contact_stiffness(Matrix& matrix) const {
  if (contact_.empty()) return;
  const auto is_free = [&](int n) { return free_.number[static_cast<std::size_t>(n)] >= 0; };
  contact_.each_block([&](int a, int b, const Mat3& K) {
    if (!is_free(a) || !is_free(b)) return;
    if (a == b)
      matrix.add_node(a, K);
    else
      matrix.add_pair(a, b, K);
  });
}

/// What grasps and the anchor have.
template <class Real>
template <class Matrix>
void BodyObjective<Real>::add_diagonal(Matrix& matrix) const {
  for (const auto& grasp : grasps_)
    grasp.each_stiffness([&](int n, Real k, Real damping) {
      matrix.add_diagonal(n, static_cast<double>(k) + (d_ > 0 ? static_cast<double>(damping) / d_ : 0));
    });
  if (regularisation_ > 0)
    for (const int n : free_.node)
      matrix.add_diagonal(n, regularisation_ * static_cast<double>(masses_->lumped[static_cast<std::size_t>(n)]));
}

template void BodyObjective<float>::linearise(const Vector&, Projection);
template void BodyObjective<float>::product(const Vector&, Vector&);
template void BodyObjective<float>::add_stiffness(BlockMatrix&);
template bool BodyObjective<float>::assemble_single_precision(BsrMatrix&);
template void BodyObjective<double>::linearise(const Vector&, Projection);
template void BodyObjective<double>::product(const Vector&, Vector&);
template void BodyObjective<double>::add_stiffness(BlockMatrix&);
template bool BodyObjective<double>::assemble_single_precision(BsrMatrix&);

}  // namespace heml
