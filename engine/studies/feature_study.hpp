#pragma once
// What each feature of a scene costs and brings (scenario/measure_features.hpp), kept as results of a study.
#include <heml/scenario/measure_features.hpp>
#include <studies/study_context.hpp>

namespace heml {

struct FeatureStudy {
  std::string scene, title;
  Measurement measurement;
};

FeatureStudy study_features(const Scene& scene, const StudyContext& context);

}  // namespace heml
