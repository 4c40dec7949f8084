#pragma once
// Load curves of a FEBio file (User's Manual, LoadData): factors of values over time, by straight lines between points.
#include <heml/scenario/feb_findings.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// A factor over the time from 0 to the end of the analysis.
struct FebFactor {
  double at_end = 1;
  /// s; it grows linearly from 0 over this time and stays, 0: it is constant. None: it does anything else.
  std::optional<double> ramp_time = 0;
};

class FebCurves {
 public:
  /// load_data: sections LoadData; end: s, of the analysis. Throws InputError for what is no curve.
  FebCurves(const std::vector<XmlElement>& load_data, double end);

  /// The factor of a value by its attribute `lc`; without one 1. What cannot be told is refused in `findings`.
  FebFactor factor_of(const XmlElement& value, FebFindings& findings) const;

 private:
  struct Curve {
    std::string interpolation = "LINEAR", extend = "CONSTANT";
    std::vector<std::pair<double, double>> points = {};  ///< s and value, ascending in time
  };
  void add(const XmlElement& curve);
  static std::optional<double> value(const Curve& curve, double time);
  std::optional<double> ramp_time(const Curve& curve, double at_end) const;

  double end_;
  std::map<int, Curve> curves_;
};

}  // namespace heml
