#pragma once
// Cost and effect of each feature of a scene (scenario/measure_features.hpp), stored as results of a study.
#include <heml/scenario/measure_features.hpp>
#include <studies/study_context.hpp>

namespace heml {

struct FeatureStudy {
  std::string scene, title;
  Measurement measurement;
};

FeatureStudy study_features(const Scene& scene, const StudyContext& context);

}  // namespace heml
