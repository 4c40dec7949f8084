#include <studies/feature_study.hpp>

namespace heml {
namespace {

Json to_json(const Measurement& measurement) {
  Json json = {{"stretch", measurement.stretch},
               {"largest_motion", measurement.max_motion},
               {"turns", measurement.turns},
               {"changes", Json::array()}};
  for (const MeasuredChange& c : measurement.changes)
    json["changes"].push_back({{"feature", c.feature},
                               {"from", c.from},
                               {"to", c.to},
                               {"milliseconds", c.milliseconds},
                               {"steps", c.steps},
                               {"error", c.error},
                               {"halted", c.halted}});
  return json;
}

Measurement measurement_from(const Json& json) {
  Measurement measurement{json["stretch"], json["largest_motion"], json["turns"], {}};
  for (const Json& c : json["changes"])
    measurement.changes.push_back({c["feature"], c["from"], c["to"], c["milliseconds"], c["steps"],
                                   c["error"].is_null() ? 0 : c["error"].get<double>(), c["halted"]});
  return measurement;
}

}  // namespace

FeatureStudy study_features(const Scene& scene, const StudyContext& context) {
  const Problem problem = problem_of(scene);
  const Json found = context.kept(key_of(problem) + "|features",
                                  [&] { return to_json(measure_features(problem.scene, problem.setup)); });
  const std::string& title = problem.scene.title;
  return {problem.scene.name, title.empty() ? problem.scene.name : title, measurement_from(found)};
}

}  // namespace heml
