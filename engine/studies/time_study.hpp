#pragma once
// Time errors: one problem solved by many methods, each compared with the reference on the same mesh.
#include <studies/accuracy_reference.hpp>
#include <studies/study_context.hpp>

namespace heml {

/// A run and its error.
struct Measured {
  Method method;
  Run run;                ///< without positions
  double error = 0;       ///< m, rms at the set time where it is largest; at least the reference's resolution
  double relative = 0;    ///< error over the reference's motion
  double last_error = 0;  ///< m, at the last set time
  std::optional<double> step_doubling;    ///< estimate over error at the first set time
  bool resolved = true;                   ///< false: the error is below the reference's resolution
  std::optional<double> frequency_error;  ///< of the first mode, relative
  std::optional<double> added_decay;      ///< 1/s, of the first mode, minus the reference's
  bool failed() const { return !run.failed.empty(); }
  double seconds_per_second() const { return run.seconds / run.simulated; }
};

struct TimeStudy {
  std::string problem;  ///< text_of(problem)
  std::size_t nodes = 0, tets = 0;
  std::string element;  ///< name
  Reference reference;  ///< without positions
  std::vector<Measured> measured;
};

/// Breadth of a sweep over methods.
enum class Breadth {
  brief,  ///< two steps of each integrator, and one above the stable limit
  whole   ///< integrators × steps × iterations, precision, threads
};
std::vector<Method> methods_of(Breadth sweep, double stable_step);

/// key: of the scene, in results. times: set times, s, ascending.
TimeStudy study_time(const std::string& key, const Problem& problem, const std::vector<double>& times, Breadth sweep,
                     const StudyContext& context);

/// Number of calls of step_done() by study_time().
std::size_t steps_of_time_study(Breadth sweep);

/// The scene's output times; if it has none, four that divide its duration evenly.
std::vector<double> set_times(const Scene& scene);

}  // namespace heml
