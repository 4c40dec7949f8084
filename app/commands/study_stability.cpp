// `heml study stability`.
#include <app/commands/commands.hpp>
#include <heml/base/error.hpp>

namespace heml {

int study_stability(const StudyArguments&) { throw UsageError("study stability: has no cases yet"); }

}  // namespace heml
