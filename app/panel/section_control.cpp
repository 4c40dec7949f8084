#include <algorithm>
#include <app/panel/keys.hpp>
#include <app/panel/section_control.hpp>
#include <cmath>
#include <numbers>
#include <utility>

namespace heml::panel {
namespace {

constexpr double section_degree = std::numbers::pi / 180;
constexpr float min_pull = 0.2f;  // of a normal in the image, relative to its length: below, it points at the eye

Vec3 direction_of(double azimuth, double elevation) {
  const double a = azimuth * section_degree, e = elevation * section_degree;
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

}  // namespace

SectionControl::SectionControl(const View& view, const SurfaceMesh& surface_mesh)
    : ball_(render::bounding_sphere(uncut_surface(surface_mesh).rest)) {
  if (!view.section) return;
  const Vec3& given = *view.section;
  at_ = view.section_at;
  axis_ = Axis::free;
  for (int k = 0; k < 3; ++k)
    if (std::abs(given[k]) == 1) {
      axis_ = static_cast<Axis>(static_cast<int>(Axis::x) + k);
      flipped_ = given[k] < 0;
    }
  azimuth_ = std::atan2(given.x(), given.z()) / section_degree;
  elevation_ = std::asin(std::clamp(given.y(), -1.0, 1.0)) / section_degree;
  last_ = axis_;
}

void SectionControl::toggle() {
  if (is_on())
    last_ = std::exchange(axis_, Axis::off);
  else
    axis_ = last_;
}

Vec3f SectionControl::normal() const {
  const float sign = flipped_ ? -1 : 1;
  if (axis_ == Axis::free) return sign * direction_of(azimuth_, elevation_).cast<float>();
  return sign * Vec3f::Unit(static_cast<int>(axis_) - static_cast<int>(Axis::x));
}

std::optional<render::SectionPlane> SectionControl::plane() const {
  if (!is_on()) return std::nullopt;
  return render::SectionPlane{normal(), normal().dot(ball_.centre) + static_cast<float>(at_)};
}

Vec3f SectionControl::handle() const { return ball_.centre + static_cast<float>(at_) * normal(); }

void SectionControl::move_to(double at) {
  const double radius = static_cast<double>(ball_.radius);
  at_ = std::clamp(at, -radius, radius);
}

void SectionControl::write_into(View& view) const {
  view.section.reset();
  view.section_at = 0;
  if (!is_on()) return;
  view.section = normal().cast<double>().normalized();
  view.section_at = at_;
}

void SectionControl::drag(const render::Vec2f& from, const render::Vec2f& to, const CameraController& controller) {
  const render::Vec2f middle = controller.pixel(handle());
  const render::Vec2f along = controller.pixel(handle() + 0.1f * ball_.radius * normal()) - middle;
  const render::Vec2f across = controller.pixel(handle() + 0.1f * ball_.radius * controller.camera().right()) - middle;
  if (!along.allFinite() || !across.allFinite() || across.norm() == 0) return;
  // A normal that points at the eye is dragged up and down.
  const bool is_foreshortened = along.norm() < min_pull * across.norm();
  const float pull = is_foreshortened ? (from - to).y() / across.norm() : (to - from).dot(along) / along.squaredNorm();
  move_to(at_ + static_cast<double>(0.1f * ball_.radius * pull));
}

void SectionControl::draw(Rows& rows) {
  static const std::vector<std::string> names{"Off", "Across x", "Across y", "Across z", "Free"};
  static const std::vector<std::string> hints{"The whole body.", "A plane with its normal along x.",
                                              "A plane with its normal along y, which points up.",
                                              "A plane with its normal along z.", "A normal given by two angles."};
  int chosen = static_cast<int>(axis_);
  if (rows.choice({"Section", "A plane that cuts the drawn body open (" + key_name(Action::section) +
                                  "). The simulation is not touched; what is left out cannot be grasped."},
                  chosen, names, hints)) {
    axis_ = static_cast<Axis>(chosen);
    if (is_on()) last_ = axis_;
  }
  if (!is_on()) return;
  const double radius = static_cast<double>(ball_.radius);
  double millimetres = 1e3 * at_;
  if (rows.slider({"Position", "Of the plane from the middle of the body at rest (mm). The handle in the image drags "
                               "it too."},
                  millimetres, {-1e3 * radius, 1e3 * radius, "%.3g mm"}))
    move_to(1e-3 * millimetres);
  if (axis_ == Axis::free) {
    rows.slider({"Azimuth", "Of the normal about the vertical (°); 0: along z."}, azimuth_, {-180, 180, "%.0f°"});
    rows.slider({"Elevation", "Of the normal above the horizon (°)."}, elevation_, {-90, 90, "%.0f°"});
  }
  if (rows.check({"Other side", "Leaves out the other side of the plane."}, flipped_)) at_ = -at_;
}

}  // namespace heml::panel
