#pragma once
// Error against run time: what `heml study accuracy` measures. The scenes are files of assets/studies/accuracy, listed
// in accuracy_scenes.cpp; or one scene of the user's.
#include <studies/feature_study.hpp>
#include <studies/law_study.hpp>
#include <studies/locking_study.hpp>
#include <studies/refinement_study.hpp>
#include <studies/scene_study.hpp>

namespace heml {

struct AccuracyOptions {
  bool quick = false;
  std::optional<Scene> scene;  ///< the user's own instead of the study's
  MakeWorld make = make_world;
  Results* results = nullptr;
  std::function<void(double fraction, const std::string& doing)> progress = [](double, const std::string&) {};
};

struct AccuracyStudy {
  std::vector<SceneStudy> scenes;
  // Of the study itself, not of a user's scene:
  std::vector<LockingBeam> locking;
  std::optional<RefinementStudy> refinement;
  std::vector<LawCheck> laws;
  std::vector<FeatureStudy> features;  ///< of a user's scene, too; not of a quick study
};

/// Throws InputError.
AccuracyStudy study_accuracy(const AccuracyOptions& options);

/// A scene of the study's, ready to be measured, and how.
struct AccuracyScene {
  std::string name;
  Problem problem;
  SceneStudyOptions options;
  double weight;  ///< of the time it takes, for the estimate of what is left
};
std::vector<AccuracyScene> accuracy_scenes(bool quick);

/// A figure that is not to grow: errors in m, deviations from theory relative. Times are none.
struct ResultValue {
  std::string name;
  double value;
};
/// Of methods whose result does not depend on the machine: not of float, nor of numbers of threads.
std::vector<ResultValue> result_values(const AccuracyStudy& study);
Json to_json(const std::vector<ResultValue>& values);

/// What is worse than what was committed, in sentences: grown by more than a tenth, or gone.
std::vector<std::string> what_got_worse(const std::vector<ResultValue>& values, const Json& committed);

}  // namespace heml
