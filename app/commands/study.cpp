// `heml study`: runs one of the studies.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <app/commands/commands.hpp>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>

namespace heml {
namespace {

struct Study {
  std::string_view kind;
  int (*run)(const StudyArguments&);
  bool takes_scene;
};
constexpr Study studies[] = {
    {"accuracy", study_accuracy, true}, {"stability", study_stability, false}, {"validation", study_validation, false}};

}  // namespace

int study(const StudyArguments& arguments) {
  std::vector<std::string_view> kinds;
  for (const Study& study : studies) {
    kinds.push_back(study.kind);
    if (study.kind != arguments.kind) continue;
    if (!study.takes_scene && !arguments.scene.empty())
      throw UsageError(fmt::format("study {}: takes no --scene", study.kind));
    make_folder(arguments.out);
    return study.run(arguments);
  }
  throw UsageError(fmt::format("study {}: the studies are {}", arguments.kind, fmt::join(kinds, ", ")));
}

}  // namespace heml
