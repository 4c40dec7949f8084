#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <heml/mesh/xml_values.hpp>
#include <heml/scenario/feb_curve.hpp>

namespace heml {
namespace {

std::string capitals_of(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

bool nearly(double a, double b, double scale) { return std::abs(a - b) <= 1e-9 * scale; }

}  // namespace

FebCurves::FebCurves(const std::vector<XmlElement>& load_data, double end) : end_(end) {
  for (const XmlElement& section : load_data)
    for (const XmlElement curve : section.children()) add(curve);
}

// 2.5: <loadcurve id type extend> of <point>; later <load_controller id type="loadcurve"> of <interpolate>, <extend>
// and <points> of <point> or <pt>.
void FebCurves::add(const XmlElement& element) {
  const int id = integer_in(element, element.attribute_or_empty("id"), "the id of a load curve");
  const auto type = element.attribute("type");
  if (element.name() == "load_controller" && type != "loadcurve") return;  // named where it is used
  Curve curve;
  if (element.name() == "loadcurve" && type) curve.interpolation = capitals_of(*type);
  if (const auto extend = element.attribute("extend")) curve.extend = capitals_of(*extend);
  if (const auto interpolate = element.child("interpolate"))
    curve.interpolation = capitals_of(std::string(interpolate->text()));
  if (const auto extend = element.child("extend")) curve.extend = capitals_of(std::string(extend->text()));
  const auto list = element.child("points");
  for (const XmlElement point : (list ? *list : element).children()) {
    if (point.name() != "point" && point.name() != "pt") continue;
    const std::vector<double> numbers = numbers_in(point, "a point of a load curve", 2);
    if (!curve.points.empty() && numbers[0] <= curve.points.back().first)
      point.fail("the points of a load curve do not ascend in time");
    curve.points.emplace_back(numbers[0], numbers[1]);
  }
  if (curve.points.empty()) element.fail("a load curve without points");
  curves_[id] = std::move(curve);
}

std::optional<double> FebCurves::value(const Curve& curve, double time) {
  const auto& points = curve.points;
  const auto next =
      std::lower_bound(points.begin(), points.end(), time, [](const auto& point, double t) { return point.first < t; });
  if (next != points.end() && next->first == time) return next->second;
  if (points.size() == 1) return points[0].second;
  const bool before = next == points.begin(), behind = next == points.end();
  const bool extrapolates = curve.extend == "EXTRAPOLATE" && curve.interpolation == "LINEAR";
  if ((before || behind) && !extrapolates) {
    if (curve.extend != "CONSTANT") return std::nullopt;
    return before ? points.front().second : points.back().second;
  }
  if (curve.interpolation == "STEP") return next->second;
  if (curve.interpolation != "LINEAR") return std::nullopt;
  const auto b = before ? next + 1 : behind ? next - 1 : next, a = b - 1;
  return a->second + (b->second - a->second) * (time - a->first) / (b->first - a->first);
}

std::optional<double> FebCurves::ramp_time(const Curve& curve, double at_end) const {
  std::vector<double> times{0, end_};
  for (const auto& point : curve.points)
    if (point.first > 0 && point.first < end_) times.push_back(point.first);
  std::sort(times.begin(), times.end());
  std::vector<double> values;
  for (const double time : times) {
    const std::optional<double> at = value(curve, time);
    if (!at) return std::nullopt;
    values.push_back(*at);
  }
  const double scale = std::abs(at_end);
  if (std::all_of(values.begin(), values.end(), [&](double v) { return nearly(v, at_end, scale); })) return 0;
  if (curve.interpolation != "LINEAR" && curve.points.size() > 1) return std::nullopt;
  const auto full = std::find_if(values.begin(), values.end(), [&](double v) { return nearly(v, at_end, scale); });
  const double ramp = times[static_cast<std::size_t>(full - values.begin())];
  for (std::size_t k = 0; k < times.size(); ++k)
    if (!nearly(values[k], at_end * std::min(1.0, times[k] / ramp), scale)) return std::nullopt;
  return ramp;
}

FebFactor FebCurves::factor_of(const XmlElement& element, FebFindings& findings) const {
  const auto lc = element.attribute("lc");
  if (!lc || lc->empty()) return {};
  const auto curve = curves_.find(integer_in(element, *lc, "the number of a load curve"));
  if (curve == curves_.end()) {
    findings.refuse(element, fmt::format("<{}> grows by load controller {}, which is not given or is no load curve",
                                         element.name(), *lc));
    return {};
  }
  const std::optional<double> at_end = value(curve->second, end_);
  if (!at_end) {
    findings.refuse(element, fmt::format("<{}> grows by load curve {}, whose value at the end cannot be told: its "
                                         "interpolation is {}, beyond its points {}",
                                         element.name(), *lc, curve->second.interpolation, curve->second.extend));
    return {};
  }
  return {*at_end, ramp_time(curve->second, *at_end)};
}

}  // namespace heml
