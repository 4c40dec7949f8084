#pragma once
// What all parts of a long study share: the results there are, how worlds are made, who looks on.
#include <functional>
#include <string>
#include <studies/problem.hpp>
#include <studies/results.hpp>

namespace heml {

struct StudyContext {
  Results* results = nullptr;  ///< none: nothing is kept
  MakeWorld make = make_world;
  std::function<void(const std::string& doing)> step_done = [](const std::string&) {};  ///< after each kept result

  /// What was found before under that key, or what measure() gives now, which is kept.
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
