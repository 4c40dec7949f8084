#pragma once
// Runs cases over all their ways, side by side on all cores, and holds what comes out against what is promised.
#include <filesystem>
#include <functional>
#include <string>
#include <studies/stability/case.hpp>
#include <vector>

namespace heml::stability {

/// One way of one case, measured.
struct Cell {
  int number;  ///< of the case
  CaseVariant variant;
  Outcome outcome;
  Verdict verdict;
  bool promised = false;
  bool short_of_promise = false;
};

/// A line of assets/studies/promised.json: these laws hold this case so, with figures of at most `limit`.
struct Promise {
  int number;
  std::optional<Integrator> integrator;
  bool single;
  double limit;
  std::vector<std::string> laws;
};

/// Throws InputError.
std::vector<Promise> read_promises(const std::filesystem::path& file);
std::filesystem::path promises_file();  ///< assets/studies/promised.json
/// What of these cells holds, as promises of the cases' own limits; the file's text.
std::string promises_text(const std::vector<Cell>& cells);

/// Marks what is promised, and what of it falls short.
void check_promises(const std::vector<Promise>& promises, std::vector<Cell>& cells);

struct StudyOptions {
  bool quick = false;
  std::vector<int> only;  ///< numbers of cases; empty: all
  std::function<void(const std::string& what, double fraction)> progress = [](const std::string&, double) {};
};

/// In the order of cases and ways. What is in `results` already, of this build and these scenes, is not run again.
std::vector<Cell> run_study(const std::filesystem::path& results, const StudyOptions& options);

}  // namespace heml::stability
