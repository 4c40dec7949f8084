#include <cmath>
#include <studies/validation/study.hpp>

namespace heml::validation {
namespace {

Json to_json(const Row& r) {
  return {{"quantity", r.quantity}, {"unit", r.unit},    {"ours", r.ours},     {"reference", r.reference},
          {"source", r.source},     {"limit", r.limit},  {"method", r.method}, {"unknowns", r.unknowns},
          {"seconds", r.seconds},   {"failed", r.failed}};
}

/// Json has no NaN: it is written as null.
double number(const Json& json) { return json.is_null() ? std::nan("") : json.get<double>(); }

Row row_from(const Json& j) {
  return {{},          j["quantity"],      j["unit"],   number(j["ours"]), number(j["reference"]),
          j["source"], number(j["limit"]), j["method"], j["unknowns"],     j["seconds"],
          j["failed"]};
}

Json to_json(const Finding& finding) {
  Json json = {{"rows", Json::array()}, {"curves", Json::array()}};
  for (const Row& row : finding.rows) json["rows"].push_back(to_json(row));
  for (const Curve& curve : finding.curves)
    json["curves"].push_back({{"name", curve.name}, {"reference", curve.reference}, {"points", curve.points}});
  return json;
}

Finding finding_from(const Json& json, const char* benchmark) {
  Finding finding;
  for (const Json& row : json["rows"]) {
    finding.rows.push_back(row_from(row));
    finding.rows.back().benchmark = benchmark;
  }
  for (const Json& curve : json["curves"]) {
    finding.curves.push_back({curve["name"], curve["reference"]});
    for (const Json& point : curve["points"])
      finding.curves.back().points.push_back({number(point[0]), number(point[1])});
  }
  return finding;
}

}  // namespace

std::vector<Validated> run_study(bool quick, const StudyContext& context) {
  std::vector<Validated> study;
  for (const Benchmark& benchmark : benchmarks()) {
    const Json found = context.kept(std::string(benchmark.name) + (quick ? "|quick" : "|full"), [&] {
      return to_json(benchmark.run({quick, context.make}));
    });
    study.push_back({&benchmark, finding_from(found, benchmark.name)});
  }
  return study;
}

}  // namespace heml::validation
