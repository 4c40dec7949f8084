#pragma once
// Shared by all parts of a long study: stored results, creation of worlds, progress.
#include <functional>
#include <string>
#include <studies/problem.hpp>
#include <studies/results.hpp>

namespace heml {

struct StudyContext {
  Results* results = nullptr;  ///< null: nothing is stored
  MakeWorld make = make_world;
  std::function<void(const std::string& doing)> step_done = [](const std::string&) {};  ///< called after each result

  /// The stored result of a key; if there is none, measures and stores it.
  Json kept(const std::string& key, const std::function<Json()>& measure) const {
    if (const Json* known = results ? results->find(key) : nullptr) {
      step_done(key);
      return *known;
    }
    const Json found = measure();
    if (results) results->add(key, found);
    step_done(key);
    return found;
  }
};

}  // namespace heml
