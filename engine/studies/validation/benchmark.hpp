#pragma once
// A benchmark of the validation study: a problem whose solution is published or follows from closed forms, ordinary
// integrals or another program. To add one: write `Finding name(const Trial&)` in a file of its own, declare it below,
// and give it a line in benchmarks.cpp. Reference solutions (references.hpp) share no code with the engine.
//
//   benchmarks() ──► run(Trial) ──► Finding: rows (ours, reference, limit) and curves ──► report.html, rows.csv
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <studies/problem.hpp>
#include <vector>

namespace heml::validation {

enum class Verdict {
  holds,     ///< within the limit
  compared,  ///< a row without limit, for comparison
  misses,    ///< beyond the limit
  fails      ///< the solve did not reach its end
};
const char* verdict_name(Verdict verdict);

inline constexpr double no_limit = std::numeric_limits<double>::quiet_NaN();

/// One value compared with its reference.
struct Row {
  std::string benchmark = {};  ///< name, set by the study
  std::string quantity, unit;
  double ours = 0, reference = 0;
  std::string source;       ///< of the reference value
  double limit = no_limit;  ///< relative; no_limit: for comparison only
  std::string method;       ///< element, or element and integrator
  std::size_t unknowns = 0;
  double seconds = 0;       ///< wall time of the solve
  std::string failed = {};  ///< why the solve stopped; empty: it did not
  double error() const;     ///< |ours − reference| / |reference|
  Verdict verdict() const;
};

/// A curve of the benchmark's chart; a reference is drawn as a line, our values as marks.
struct Curve {
  std::string name;
  bool reference = false;
  std::vector<std::array<double, 2>> points = {};
};

struct Finding {
  std::vector<Row> rows;
  std::vector<Curve> curves;
};

/// The input of a benchmark; tests pass a `make` that creates faulty worlds.
struct Trial {
  bool quick = false;
  MakeWorld make = make_world;
};

struct Benchmark {
  const char* name;         ///< in files
  const char* title;        ///< heading
  const char* description;  ///< body, load, what is compared
  const char* source;       ///< of the reference
  const char *x_label, *y_label, *y_unit;
  Finding (*run)(const Trial&);
};

std::span<const Benchmark> benchmarks();

Finding thick_sphere(const Trial&);
Finding thick_cylinder(const Trial&);
Finding elastica(const Trial&);
Finding cook_membrane(const Trial&);
Finding relaxation(const Trial&);
Finding creep(const Trial&);
Finding viscous_loop(const Trial&);
Finding plastic_cycle(const Trial&);
Finding ball_contact(const Trial&);
Finding land_beam(const Trial&);
Finding land_ventricle(const Trial&);
Finding land_contraction(const Trial&);

}  // namespace heml::validation
