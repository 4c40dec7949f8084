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
  bool takes_scene, takes_cases;
};
constexpr Study studies[] = {{"accuracy", study_accuracy, true, true},
                             {"stability", study_stability, false, true},
                             {"validation", study_validation, false, false}};

}  // namespace

void check_case_numbers(const StudyArguments& arguments, int last) {
  for (const int number : arguments.cases)
    if (number > last)
      throw UsageError(fmt::format("study {}{}: --case is {}, the cases are 1 to {}", arguments.kind,
                                   arguments.quick ? " --quick" : "", number, last));
}

int study(const StudyArguments& arguments) {
  std::vector<std::string_view> kinds;
  for (const Study& study : studies) {
    kinds.push_back(study.kind);
    if (study.kind != arguments.kind) continue;
    if (!study.takes_scene && !arguments.scene.empty())
      throw UsageError(fmt::format("study {}: takes no --scene", study.kind));
    if (!study.takes_cases && !arguments.cases.empty())
      throw UsageError(fmt::format("study {}: takes no --case", study.kind));
    make_folder(arguments.out);
    return study.run(arguments);
  }
  throw UsageError(fmt::format("study {}: the studies are {}", arguments.kind, fmt::join(kinds, ", ")));
}

}  // namespace heml
