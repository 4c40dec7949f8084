#include <heml/mesh/field_of_piece.hpp>
#include <heml/mesh/quadratic.hpp>

namespace heml {
namespace {

Vec3 place_of(const std::array<Vec3, 4>& corners, std::size_t q) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < 4; ++c) sum += point_coordinate(q, c) * corners[c];
  return sum;
}

/// Directions at the integration points of an element, as a linear function of the place.
class DirectionField {
 public:
  DirectionField(const double* values, const std::array<Vec3, 4>& corners) {
    Mat3 places, differences;
    for (std::size_t q = 0; q < element_points; ++q) {
      Vec3 direction = Eigen::Map<const Vec3>(values + 3 * q);
      if (q == 0) {
        origin_ = place_of(corners, 0), at_origin_ = direction;
        continue;
      }
      if (direction.dot(at_origin_) < 0) direction = -direction;
      places.col(static_cast<int>(q) - 1) = place_of(corners, q) - origin_;
      differences.col(static_cast<int>(q) - 1) = direction - at_origin_;
    }
    gradient_ = differences * places.inverse();
  }
  Vec3 at(const Vec3& place) const {
    const Vec3 direction = at_origin_ + gradient_ * (place - origin_);
    const double length = direction.norm();
    return length > 0 ? Vec3(direction / length) : at_origin_;
  }

 private:
  Vec3 origin_, at_origin_;
  Mat3 gradient_;
};

}  // namespace

void append_piece(const ElementField& field, const TetMesh& mesh, int element, const std::array<Vec3, 4>& corners,
                  std::vector<double>& values) {
  const auto t = static_cast<std::size_t>(element);
  const std::size_t first = field.components * t;
  if (field.components != point_components) {
    for (std::size_t c = 0; c < field.components; ++c) values.push_back(field.values[first + c]);
    return;
  }
  const DirectionField directions(&field.values[first], rest_corners(mesh, mesh.tets[t]));
  for (std::size_t q = 0; q < element_points; ++q) {
    const Vec3 direction = directions.at(place_of(corners, q));
    values.insert(values.end(), direction.begin(), direction.end());
  }
}

ElementField field_of_pieces(const ElementField& field, const TetMesh& mesh, const TetMesh& pieces,
                             const std::vector<int>& parents) {
  ElementField result{field.name, field.components, {}};
  result.values.reserve(field.components * parents.size());
  for (std::size_t t = 0; t < parents.size(); ++t)
    append_piece(field, mesh, parents[t], rest_corners(pieces, pieces.tets[t]), result.values);
  return result;
}

}  // namespace heml
