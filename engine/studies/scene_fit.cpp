#include <fmt/format.h>

#include <cmath>
#include <heml/base/error.hpp>
#include <heml/math/least_squares.hpp>
#include <heml/scenario/csv_text.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/scene_numbers.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/text_file.hpp>
#include <limits>
#include <studies/scene_fit.hpp>

namespace heml {
namespace {

using Vector = Eigen::VectorXd;

constexpr int most_iterations = 40;
constexpr double equilibrium_tolerance = 1e-9;  // of the residual, relative: differences are exact to 1e-6
constexpr double smallest_singular_value = 1e-5;
constexpr double difference = 1e-3;  // relative

bool stays_positive(const FitStart& start, double initial) {
  return initial > 0 &&
         (start.path == "mesh.scale" || (start.path.starts_with("materials[") && !start.path.ends_with(".poisson")));
}

/// The scene as statics, without what a fit leaves out.
Scene static_scene(Scene scene) {
  SolverSettings solver;
  solver.integrator = Integrator::static_equilibrium;
  solver.nodal_pressure = scene.solver.nodal_pressure;
  solver.quadratic = scene.solver.quadratic;
  solver.threads = scene.solver.threads;
  solver.tolerance = equilibrium_tolerance;
  scene.solver = solver;
  scene.events.clear(), scene.points.clear(), scene.markers.clear(), scene.output_times.clear();
  scene.checkpoints.clear();
  scene.output_history = false;
  return scene;
}

/// Computed minus measured places as a function of the sought variables: logarithms of numbers that stay positive, else
/// numbers over their scale.
class SceneMisfit {
 public:
  SceneMisfit(const Scene& scene, const MeasuredPlaces& measured, const std::vector<FitStart>& starts)
      : file_(scene.file), measured_(measured), starts_(starts) {
    given_ = parse_json(scene_text(scene), file_);
    statics_ = parse_json(scene_text(static_scene(scene)), file_);
    for (const FitStart& start : starts) {
      name_moduli(given_, start.path), name_moduli(statics_, start.path);
      const double initial = start.initial.value_or(number_at(statics_, start.path));
      initial_.push_back(initial);
      positive_.push_back(stays_positive(start, initial));
      scale_.push_back(initial != 0 ? std::abs(initial) : 1);
      set_number(statics_, start.path, initial);
    }
    selected_ = load_setup(parse_scene(statics_.dump(), file_));
    for (const int node : measured.nodes)
      if (static_cast<std::size_t>(node) >= selected_.mesh.nodes.size())
        throw InputError(file_, "", fmt::format("has no node {}: the mesh has {}", node, selected_.mesh.nodes.size()),
                         "give nodes in the order of the mesh file, from 0");
  }

  double initial(std::size_t i) const { return initial_[i]; }
  int equilibria() const { return equilibria_; }

  Vector start() const {
    Vector u(std::ssize(starts_));
    for (std::size_t i = 0; i < starts_.size(); ++i)
      u[static_cast<Eigen::Index>(i)] = positive_[i] ? std::log(initial_[i]) : initial_[i] / scale_[i];
    return u;
  }
  /// 1 where a number stays positive, else 0.
  Vector positive() const {
    Vector result(std::ssize(starts_));
    for (std::size_t i = 0; i < starts_.size(); ++i) result[static_cast<Eigen::Index>(i)] = positive_[i] ? 1 : 0;
    return result;
  }
  double value(std::size_t i, const Vector& u) const {
    const double at = u[static_cast<Eigen::Index>(i)];
    return positive_[i] ? std::exp(at) : at * scale_[i];
  }
  double value_per_u(std::size_t i, const Vector& u) const { return positive_[i] ? value(i, u) : scale_[i]; }

  /// The scene as given with the numbers of u.
  Scene scene_at(const Vector& u) const { return parse_scene(with_numbers(given_, u).dump(), file_); }

  /// The equilibrium, #V, m. Throws InputError where there is none, or a number is none that a scene may have.
  std::vector<Vec3> equilibrium(const Vector& u) {
    ++equilibria_;
    const Scene scene = parse_scene(with_numbers(statics_, u).dump(), file_);
    WorldSetup setup = load_setup(scene);
    for (std::size_t i = 0; i < setup.boundary.size(); ++i) setup.boundary[i].nodes = selected_.boundary[i].nodes;
    for (std::size_t i = 0; i < setup.loads.size(); ++i) setup.loads[i].nodes = selected_.loads[i].nodes;
    const auto world = make_world(setup);
    const SolveFacts facts = solve(scene, *world);
    if (facts.halt) throw InputError(file_, "", facts.halt->message, "begin nearer to the solution, or load less");
    if (!facts.converged)
      throw InputError(file_, "", "the equilibrium did not converge", "begin nearer to the solution");
    return world->positions();
  }

  /// In units of sigma where it is given, else m; 3 #m.
  std::optional<Vector> residuals(const Vector& u) {
    if (!u.allFinite()) return std::nullopt;
    try {
      const std::vector<Vec3> x = equilibrium(u);
      Vector r(3 * std::ssize(measured_.nodes));
      for (std::size_t k = 0; k < measured_.nodes.size(); ++k)
        r.segment<3>(3 * static_cast<Eigen::Index>(k)) =
            (x[static_cast<std::size_t>(measured_.nodes[k])] - measured_.places[k]) / sigma(k);
      return r;
    } catch (const InputError&) {  // the next step is shorter
      return std::nullopt;
    }
  }
  double sigma(std::size_t k) const { return measured_.sigma.empty() ? 1 : measured_.sigma[k]; }

 private:
  Json with_numbers(Json scene, const Vector& u) const {
    for (std::size_t i = 0; i < starts_.size(); ++i) set_number(scene, starts_[i].path, value(i, u));
    return scene;
  }

  std::string file_;
  const MeasuredPlaces& measured_;
  const std::vector<FitStart>& starts_;
  Json given_, statics_;
  std::vector<double> initial_, scale_;
  std::vector<bool> positive_;
  WorldSetup selected_;  ///< at the initial values: whose selections hold for all
  int equilibria_ = 0;
};

/// The start with all numbers that stay positive multiplied by the factor that fits best: how stiff a body is as a
/// whole places tell first, and far from that derivatives mislead.
Vector common_multiple(const LeastSquaresProblem& problem, const SceneMisfit& misfit) {
  const Vector start = misfit.start(), shared = misfit.positive();
  const auto along = [&](const Vector& t) { return problem.residuals(start + t[0] * shared); };
  LeastSquaresOptions options;
  options.max_iterations = most_iterations;
  options.change = 1, options.step = 1e-3;
  return start + minimise_squares({along, problem.difference_step}, Vector::Zero(1), options).u[0] * shared;
}

}  // namespace

MeasuredPlaces read_places_csv(const std::filesystem::path& path) {
  const std::string content = read_text_file(path);
  std::string_view text = content;
  const auto fail = [&](long line, const std::string& problem, const std::string& remedy) {
    throw InputError(path.string(), fmt::format("line {}", line), problem, remedy);
  };
  MeasuredPlaces measured;
  bool has_header = false, has_sigma = false;
  for (long line = 1; !text.empty(); ++line) {
    const std::string_view entry = consume_line(text);
    std::string_view rest = entry;
    if (is_blank(entry) || entry.starts_with('#')) continue;
    if (!has_header) {
      has_header = true;
      has_sigma = entry == "node,x,y,z,sigma";
      if (!has_sigma && entry != "node,x,y,z")
        fail(line, fmt::format("is '{}'", shown(entry)), "must be the header node,x,y,z or node,x,y,z,sigma (metres)");
      continue;
    }
    int node = 0;
    Vec3 place;
    double sigma = 1;
    const bool reads = consume_number(rest, node) && consume_number(rest, place.x()) &&
                       consume_number(rest, place.y()) && consume_number(rest, place.z()) &&
                       (!has_sigma || consume_number(rest, sigma)) && rest.empty();
    if (!reads || node < 0 || !place.allFinite() || !std::isfinite(sigma))
      fail(line, fmt::format("is '{}'", shown(entry)), "must be a node number and its place, finite numbers");
    if (!(sigma > 0)) fail(line, fmt::format("the sigma is {}", sigma), "must be greater than 0");
    measured.nodes.push_back(node);
    measured.places.push_back(place);
    if (has_sigma) measured.sigma.push_back(sigma);
  }
  if (measured.nodes.empty())
    throw InputError(path.string(), "", "holds no measured place", "give the header node,x,y,z and one node a line");
  return measured;
}

SceneFit fit_scene(const Scene& scene, const MeasuredPlaces& measured, const std::vector<FitStart>& starts,
                   const std::function<void(double)>& progress) {
  if (3 * measured.nodes.size() < starts.size())
    throw InputError(
        scene.file, "",
        fmt::format("{} measured coordinates cannot tell {} numbers", 3 * measured.nodes.size(), starts.size()),
        "measure more nodes, or fit fewer numbers");
  SceneMisfit misfit(scene, measured, starts);
  misfit.equilibrium(misfit.start());
  LeastSquaresOptions options;
  options.max_iterations = most_iterations;
  options.change = 1;  // the step decides: measured places are not met exactly
  options.step = 1e-7;
  options.progress = progress;
  const LeastSquaresProblem problem{[&](const Vector& u) { return misfit.residuals(u); }, difference};
  LeastSquaresFit found = minimise_squares(problem, misfit.start(), options);
  if (!found.converged && misfit.positive().sum() > 1) {
    LeastSquaresFit again = minimise_squares(problem, common_multiple(problem, misfit), options);
    const bool is_better = again.converged || again.r.squaredNorm() < found.r.squaredNorm();
    again.iterations += found.iterations;
    if (is_better) found = std::move(again);
  }

  SceneFit fit;
  const bool knows_sigma = !measured.sigma.empty();
  const Certainty certain = certainty(found, knows_sigma ? std::optional(1.0) : std::nullopt, smallest_singular_value);
  const double quantile = knows_sigma ? student_quantile(std::numeric_limits<long>::max())
                                      : student_quantile(static_cast<long>(found.r.size() - found.u.size()));
  for (std::size_t i = 0; i < starts.size(); ++i) {
    FittedNumber number{starts[i].path, misfit.initial(i), misfit.value(i, found.u)};
    number.standard_error = certain.undetermined[i]
                                ? std::numeric_limits<double>::infinity()
                                : certain.error[static_cast<Eigen::Index>(i)] * misfit.value_per_u(i, found.u);
    number.low = number.value - quantile * number.standard_error;
    number.high = number.value + quantile * number.standard_error;
    fit.numbers.push_back(number);
  }
  double sum = 0;
  for (std::size_t k = 0; k < measured.nodes.size(); ++k) {
    fit.residuals.push_back(found.r.segment<3>(3 * static_cast<Eigen::Index>(k)) * misfit.sigma(k));
    sum += fit.residuals.back().squaredNorm();
  }
  fit.rms = std::sqrt(sum / static_cast<double>(found.r.size()));
  fit.equilibria = misfit.equilibria();
  fit.iterations = found.iterations;
  fit.converged = found.converged;
  fit.scene = misfit.scene_at(found.u);
  return fit;
}

}  // namespace heml
