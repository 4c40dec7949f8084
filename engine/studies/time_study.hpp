#pragma once
// Errors of time: one specimen moved by many methods, each held against the reference on the same mesh.
#include <studies/accuracy_reference.hpp>
#include <studies/study_context.hpp>

namespace heml {

/// A run and its error.
struct Measured {
  Method method;
  Run run;                ///< without positions
  double error = 0;       ///< m, rms at the set time where it is largest; at least the reference's resolution
  double relative = 0;    ///< of the reference's motion
  double last_error = 0;  ///< m, at the last set time
  std::optional<double> step_doubling;    ///< what the panel's gauge says at the first set time, of the error there
  bool resolved = true;                   ///< the error itself was not below what the reference can tell
  std::optional<double> frequency_error;  ///< of the first mode, relative
  std::optional<double> added_decay;      ///< 1/s, of the first mode, beyond the reference's
  bool failed() const { return !run.failed.empty(); }
  double seconds_per_second() const { return run.seconds / run.simulated; }
};

struct TimeStudy {
  std::string problem;  ///< text_of(specimen)
  std::size_t nodes = 0, tets = 0;
  bool nodal_pressure = false;
  Reference reference;  ///< without positions
  std::vector<Measured> measured;
};

/// How wide a sweep is.
enum class Breadth {
  brief,  ///< two steps of each integrator, and one above the stable limit
  whole   ///< integrators × steps × iterations, precision, threads
};
std::vector<Method> methods_of(Breadth sweep, double stable_step);

/// key: of the scene, in results. times: s.
TimeStudy study_time(const std::string& key, const Problem& problem, const std::vector<double>& times, Breadth sweep,
                     const StudyContext& context);

/// How many times step_done() will be called by it.
std::size_t steps_of_time_study(Breadth sweep);

/// The scene's own output times, or four that part its duration evenly.
std::vector<double> set_times(const Scene& scene);

}  // namespace heml
