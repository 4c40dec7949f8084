#pragma once
// Error against run time: what `heml study accuracy` measures. The scenes are files of assets/studies/accuracy, listed
// in accuracy_scenes.cpp; or one scene of the user.
#include <studies/feature_study.hpp>
#include <studies/law_study.hpp>
#include <studies/locking_study.hpp>
#include <studies/refinement_study.hpp>
#include <studies/scene_study.hpp>

namespace heml {

struct AccuracyOptions {
  bool quick = false;
  std::optional<Scene> scene;  ///< the user's scene; none: those of the study
  std::vector<int> only = {};  ///< of the study's own cases these, by number from 1; empty: all
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
  std::vector<FeatureStudy> features;  ///< also of a user's scene; empty in a quick study
};

/// The study's own cases: laws, beams, each scene, and in a full study each scene that features are measured in.
int accuracy_case_count(bool quick);

/// Throws InputError.
AccuracyStudy study_accuracy(const AccuracyOptions& options);

/// A loaded scene of the study and how it is measured.
struct AccuracyScene {
  std::string name;
  Problem problem;
  SceneStudyOptions options;
  double weight;  ///< expected computing time, for the progress
};
std::vector<AccuracyScene> accuracy_scenes(bool quick);

/// A value that must not grow: an error (m) or a relative deviation from theory; never a time.
struct ResultValue {
  std::string name;
  double value;
};
/// Values of the methods whose results are the same on every machine: in double, on one thread.
std::vector<ResultValue> result_values(const AccuracyStudy& study);
Json to_json(const std::vector<ResultValue>& values);

/// One sentence for each value of `committed` that has grown by more than a tenth or is missing.
std::vector<std::string> what_got_worse(const std::vector<ResultValue>& values, const Json& committed);

}  // namespace heml
