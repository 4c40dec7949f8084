#pragma once
// Runs all variants of the cases in parallel on all cores and checks the outcomes against the promises.
#include <filesystem>
#include <functional>
#include <string>
#include <studies/stability/case.hpp>
#include <vector>

namespace heml::stability {

/// One variant of one case, measured.
struct Cell {
  int number;  ///< of the case
  CaseVariant variant;
  Outcome outcome;
  Verdict verdict;
  bool promised = false;
  bool short_of_promise = false;
};

/// A line of assets/studies/promised.json: with these laws the case holds, with values of at most `limit`.
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
/// The text of a promises file: all cells that hold, with the limits of their cases.
std::string promises_text(const std::vector<Cell>& cells);

/// Marks promised cells and those that fall short.
void check_promises(const std::vector<Promise>& promises, std::vector<Cell>& cells);

struct StudyOptions {
  bool quick = false;
  std::vector<int> only;  ///< numbers of cases; empty: all
  std::function<void(const std::string& what, double fraction)> progress = [](const std::string&, double) {};
};

/// Cells in the order of cases and variants. Results of this build and these scenes found in `results` are reused.
std::vector<Cell> run_study(const std::filesystem::path& results, const StudyOptions& options);

}  // namespace heml::stability
