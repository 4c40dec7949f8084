#pragma once
// Fits numbers of a scene to measured places of its nodes in static equilibrium: least squares (math/least_squares.hpp)
// whose derivatives are differences of equilibria. The Python module's heml.fit has exact derivatives.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// Where nodes were measured.
struct MeasuredPlaces {
  std::vector<int> nodes;     ///< #m, mesh-file order
  std::vector<Vec3> places;   ///< #m, m
  std::vector<double> sigma;  ///< #m, m, standard deviation of a coordinate; empty: estimated from the residuals
};

/// Reads the header `node,x,y,z` or `node,x,y,z,sigma` and one node a line, m. Lines that begin with # are skipped.
/// Throws InputError naming the line.
MeasuredPlaces read_places_csv(const std::filesystem::path& path);

struct FittedNumber {
  std::string path;  ///< scene_numbers.hpp
  double initial = 0;
  double value = 0;
  double standard_error = 0;  ///< infinite where the places do not determine it
  double low = 0, high = 0;   ///< 95 % confidence interval, linearised at the solution
};

struct SceneFit {
  std::vector<FittedNumber> numbers;
  std::vector<Vec3> residuals;  ///< #m, m: computed minus measured
  double rms = 0;               ///< m, of the residuals' components
  int equilibria = 0;           ///< that were computed
  int iterations = 0;
  bool converged = false;
  Scene scene;  ///< with the fitted numbers, else as given
};

/// A number to fit, and where the search begins: at the scene's value unless given.
struct FitStart {
  std::string path;
  std::optional<double> initial;
};

/// Loads act in full; events are left out. Numbers of materials and mesh.scale that begin above 0 stay above 0.
/// Selected nodes are those of the initial shape. progress: called with the fraction of the largest number of
/// iterations. Throws InputError for unknown paths or nodes, or where the scene has no equilibrium at the initial
/// values.
SceneFit fit_scene(const Scene& scene, const MeasuredPlaces& measured, const std::vector<FitStart>& starts,
                   const std::function<void(double)>& progress = {});

}  // namespace heml
