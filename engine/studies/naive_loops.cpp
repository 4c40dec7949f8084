#include <heml/base/log.hpp>
#include <string>
#include <studies/naive_loops.hpp>

namespace heml {
namespace {

#define HEML_NAME(macro, name) , name
constexpr const char* feature_names[] = {"" HEML_X86_FEATURES(HEML_NAME)};
#undef HEML_NAME

const NaiveSet& set_of_this_processor() {
#define HEML_SUPPORTED(macro, name) , __builtin_cpu_supports(name) != 0
  static const bool has[] = {true HEML_X86_FEATURES(HEML_SUPPORTED)};
#undef HEML_SUPPORTED
  static const NaiveSet& set = [&]() -> const NaiveSet& {
    const NaiveSet& chosen = naive_set(has);
    if (&chosen != &native_naive_set)
      warn(
          "the naive loops were compiled for a processor with {}, which this one lacks: they run as compiled with {}, "
          "and "
          "are slower than they could be; build heml on this machine to compare with it",
          feature_names[missing_feature(native_naive_set, has)], chosen.flags);
    return chosen;
  }();
  return set;
}

}  // namespace

std::size_t missing_feature(const NaiveSet& set, std::span<const bool> has) {
  for (std::size_t k = 0; k < set.features; ++k)
    if (set.compiled_for[k] && !has[k]) return k;
  return 0;
}

const NaiveSet& naive_set(std::span<const bool> has) {
  return missing_feature(native_naive_set, has) ? portable_naive_set : native_naive_set;
}

NaiveLoop naive_loop(const NaiveSet& set, std::string_view law) {
  for (std::size_t k = 0; k < set.count; ++k)
    if (set.entries[k].law == law) return set.entries[k].loop;
  return nullptr;
}

NaiveLoop naive_loop(std::string_view law) { return naive_loop(set_of_this_processor(), law); }

const char* naive_flags() { return set_of_this_processor().flags; }

}  // namespace heml
