#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <studies/force_timing.hpp>
#include <studies/naive.hpp>

namespace heml {
namespace {

/// ‖f − reference‖ / ‖reference‖.
template <class Real>
double distance(const std::vector<Real>& f, const std::vector<double>& reference) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double d = static_cast<double>(f[i]) - reference[i];
    difference += d * d;
    size += reference[i] * reference[i];
  }
  return std::sqrt(difference / size);
}

/// The force evaluations of one body that are timed, and their entries.
struct Contest {
  const BenchBody& body;
  const Material& material;
  const std::vector<double>& reference;
  std::vector<std::function<void()>> works;
  std::vector<ForceTiming> entries;

  template <class Real>
  void add_variants(const char* precision, double max_difference) {
    const auto x = std::make_shared<std::vector<Real>>(as_reals<Real>(body.x));
    const auto f = std::make_shared<std::vector<Real>>(x->size());
    for (const InstructionSet isa : kernels_of(material)) {
      BodyOptions options;
      options.instruction_set = isa;
      const std::string name(name_of(isa));
      const auto elastic = std::make_shared<ElasticBody<Real>>(body.mesh, std::vector<int>(body.mesh.tets.size(), 0),
                                                               std::vector{material}, options);
      const double bytes = elastic->kernels().front().bytes_per_tet;
      for (const int threads : bench_threads()) {
        const auto team = std::make_shared<ThreadTeam>(threads);
        elastic->forces(x->data(), f->data(), *team);
        if (const double difference = distance(*f, reference); !(difference < max_difference))
          throw std::logic_error(fmt::format("forces of {} ({}, {}) are {:.1e} off the naive loop's", material.law,
                                             precision, name, difference));
        works.push_back([=] { elastic->forces(x->data(), f->data(), *team); });
        entries.push_back({material.law, precision, name, threads, false, {}, bytes, 1});
      }
    }
  }
};

}  // namespace

std::vector<ForceTiming> time_forces(const BenchBody& body, const Material& material, const TimingLimits& limits) {
  const FlushDenormals flush;
  const NaiveForces naive(body.mesh, material);
  std::vector<double> reference(body.x.size()), f(body.x.size());
  naive(body.x.data(), reference.data());
  Contest contest{body, material, reference, {}, {}};
  contest.works.push_back([&] { naive(body.x.data(), f.data()); });
  contest.entries.push_back({material.law, "double", "native", 1, true, {}, 0, 1});
  contest.add_variants<double>("double", 1e-10);
  contest.add_variants<float>("float", 1e-2);
  const auto times = time_interleaved(contest.works, limits);
  for (std::size_t k = 0; k < times.size(); ++k) {
    contest.entries[k].time = times[k];
    contest.entries[k].ratio_to_naive = times[0].min / times[k].min;
  }
  return contest.entries;
}

BenchRow force_row(const ForceTiming& timing, const BenchBody& body) {
  const double tets = static_cast<double>(body.mesh.tets.size());
  BenchRow row;
  row.name = timing.naive ? "naive force" : "force";
  row.mesh = body.name;
  row.nodes = body.mesh.nodes.size();
  row.tets = body.mesh.tets.size();
  row.law = timing.law;
  row.precision = timing.precision;
  row.isa = timing.isa;
  row.threads = timing.threads;
  row.median = 1e9 * timing.time.median / tets;
  row.min = 1e9 * timing.time.min / tets;
  row.unit = "ns/tet";
  if (!timing.naive) row.ratio_to_naive = timing.ratio_to_naive;
  row.more = {{"spread", timing.time.spread}, {"samples", timing.time.samples}};
  return row;
}

}  // namespace heml
