#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <heml/base/hash.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/text_file.hpp>
#include <mutex>
#include <numeric>
#include <set>
#include <studies/results.hpp>
#include <studies/stability/study.hpp>
#include <thread>

namespace heml::stability {
namespace {

/// Hash of all files that the cases read.
std::string fingerprint_of_scenes() {
  std::uint64_t hash = 0;
  for (const char* folder : {"scenes/extreme", "meshes"}) {
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / folder)) files.insert(entry.path());
    for (const auto& file : files)
      for (const char c : file.filename().string() + read_text_file(file))
        hash = hash_combine(hash, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  return fmt::format("{:016x}", hash);
}

std::string key_of(const Cell& cell, bool quick, const std::string& scenes) {
  return fmt::format("{}|{}|{}|{}", cell.number, to_text(cell.variant), quick ? "quick" : "full", scenes);
}

Json to_json(const Outcome& outcome) {
  return {{"figure", outcome.value},    {"inverted", outcome.inverted}, {"recoveries", outcome.recoveries},
          {"stopped", outcome.stopped}, {"broken", outcome.broken},     {"note", outcome.note},
          {"proof", outcome.proof}};
}

Outcome outcome_from(const Json& json) {
  const Json& value = json["figure"];  // null: not finite
  return {value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>(),
          json["inverted"],
          json["recoveries"],
          json["stopped"],
          json["broken"],
          json["note"],
          json["proof"]};
}

Outcome run_cell(const Cell& cell, bool quick) {
  Trial trial;
  trial.variant = cell.variant;
  trial.quick = quick;
  return case_numbered(cell.number).run(trial);
}

std::vector<Cell> cells_of(const StudyOptions& options) {
  std::vector<Cell> cells;
  for (const Case& c : cases()) {
    if (!options.only.empty() && std::find(options.only.begin(), options.only.end(), c.number) == options.only.end())
      continue;
    for (CaseVariant& variant : variants_of(c, options.quick)) cells.push_back({c.number, std::move(variant), {}, {}});
  }
  return cells;
}

}  // namespace

std::vector<Cell> run_study(const std::filesystem::path& file, const StudyOptions& options) {
  std::vector<Cell> cells = cells_of(options);
  Results results(file);
  const std::string scenes = fingerprint_of_scenes();
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (const Json* known = results.find(key_of(cells[k], options.quick, scenes)))
      cells[k].outcome = outcome_from(*known);
    else
      open.push_back(k);
  // In pseudo-random order, so that the fraction done predicts the remaining time.
  std::sort(open.begin(), open.end(), [](std::size_t a, std::size_t b) {
    return hash_combine(1, static_cast<std::uint64_t>(a)) < hash_combine(1, static_cast<std::uint64_t>(b));
  });

  std::mutex door;
  std::size_t next = 0, done = 0;
  std::exception_ptr error;
  const auto work = [&] {
    std::unique_lock lock(door);
    while (next < open.size() && !error) {
      Cell& cell = cells[open[next++]];
      lock.unlock();
      Outcome outcome;
      std::exception_ptr thrown;
      const auto begin = std::chrono::steady_clock::now();
      try {
        outcome = run_cell(cell, options.quick);
      } catch (...) {
        thrown = std::current_exception();
      }
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      lock.lock();
      if (thrown) {
        error = thrown;
        break;
      }
      Json json = to_json(outcome);
      json["seconds"] = seconds;  // for information only
      cell.outcome = outcome_from(results.add(key_of(cell, options.quick, scenes), json));
      options.progress(fmt::format("{}, {}", case_numbered(cell.number).name, to_text(cell.variant)),
                       static_cast<double>(++done) / static_cast<double>(open.size()));
    }
  };
  std::vector<std::thread> workers;
  for (unsigned k = 0; k < std::max(1u, std::thread::hardware_concurrency()); ++k) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  if (error) std::rethrow_exception(error);
  for (Cell& cell : cells) cell.verdict = judge(cell.outcome, case_numbered(cell.number).limit_of(cell.variant));
  return cells;
}

}  // namespace heml::stability
