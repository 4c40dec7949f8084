#include <fmt/format.h>

#include <algorithm>
#include <heml/scenario/build_identity.hpp>
#include <heml/scenario/verify.hpp>

namespace heml {
namespace {

/// Why states cannot be compared because another kernel revision recorded them; empty: they can.
std::string made_by_other(const Scene& recording) {
  const RecordedBy& by = recording.recorded_by;
  if (by.format > 1 && by.kernel_revision != kernel_revision)
    return fmt::format(
        "it was recorded by kernel revision {}{}, and this build has revision {}: their states differ, so they cannot "
        "be compared",
        by.kernel_revision, by.build.empty() ? "" : fmt::format(" ({})", by.build), kernel_revision);
  return "";
}

/// Suffix for a message that names another build or instruction set as a possible cause of a difference.
std::string other_build(const Scene& recording) {
  if (recording.recorded_instructions && !plays_as_recorded(recording))
    return fmt::format(
        "; its states were recorded with {} kernels, which this processor does not have: others differ by round-off, "
        "so they cannot be compared",
        name_of(*recording.recorded_instructions));
  const std::string& build = recording.recorded_by.build;
  if (build.empty() || build == build_name()) return "";
  return fmt::format("; it was recorded by another build ({}; this is {}), and other builds may differ by round-off",
                     build, build_name());
}

std::string why_halts_differ(const Scene& recording, const ReplayResult& played) {
  const auto& end = recording.recorded_end;
  if (!played.halt)
    return end && end->halt ? fmt::format("did not stop at step {} as recorded: {}", end->tick, *end->halt) : "";
  if (!end) return "";  // a recording that was cut short may halt later
  if (!end->halt)
    return fmt::format("stopped at step {}, where the recording goes on: {}", played.ticks, played.halt->message);
  if (played.ticks == end->tick && played.halt->message == *end->halt) return "";
  return fmt::format("stopped at step {}: {}; recorded at step {}: {}", played.ticks, played.halt->message, end->tick,
                     *end->halt);
}

/// Completeness check for format 1, whose end record has no count: checkpoints were written at regular intervals, and
/// one at the end unless a command of that tick had changed the state.
bool evenly_spaced(const Scene& recording) {
  const std::vector<Checkpoint>& all = recording.checkpoints;
  const long end = recording.recorded_end->tick;
  if (all.size() == 1) return all[0].tick == end;  // recording of a recovery
  const long spacing = all[1].tick - all[0].tick;
  const bool closed = all.back().tick == end;
  const std::size_t regular = closed ? all.size() - 1 : all.size();
  for (std::size_t k = 0; k < regular; ++k)
    if (all[k].tick != static_cast<long>(k) * spacing) return false;
  const bool ends_on_command = std::any_of(recording.events.begin(), recording.events.end(),
                                           [&](const Event& event) { return event.tick == end; });
  const long last_gap = end - all[regular - 1].tick;
  return last_gap > 0 && (closed ? last_gap <= spacing : last_gap < spacing && ends_on_command);
}

/// Why a recording with an end record is incomplete; empty: it is complete.
std::string why_not_whole(const Scene& recording) {
  const RecordedEnd& end = *recording.recorded_end;
  const auto found = static_cast<long>(recording.checkpoints.size());
  if (recording.checkpoints.back().tick > end.tick)
    return fmt::format("it holds a checkpoint of step {}, after its end at step {}", recording.checkpoints.back().tick,
                       end.tick);
  if (!recording.events.empty() && recording.events.back().tick > end.tick)
    return fmt::format("it holds an event of step {}, after its end at step {}", recording.events.back().tick,
                       end.tick);
  if (end.halted && *end.halted != end.halt.has_value())
    return fmt::format("its end at step {} says that the run {}", end.tick,
                       *end.halted ? "halted, and not why" : "did not halt, and why it did");
  if (end.checkpoints && *end.checkpoints != found)
    return fmt::format("it holds {} checkpoints, and its end tells of {}", found, *end.checkpoints);
  if (recording.recorded_by.format > 1)
    return end.checkpoints && end.hash ? "" : "its end record lacks 'checkpoints' or 'hash'";
  return evenly_spaced(recording)
             ? ""
             : fmt::format("its checkpoints are not evenly spaced up to its end at step {}: some are missing",
                           end.tick);
}

std::string why_not(const Scene& recording, const ReplayResult& played, bool partial) {
  if (const std::string other = made_by_other(recording); !other.empty()) return other;
  if (played.difference) return to_text(*played.difference) + other_build(recording);
  if (recording.checkpoints.empty()) return "it holds no checkpoint, so nothing could be verified";
  if (const std::string halts = why_halts_differ(recording, played); !halts.empty())
    return halts + other_build(recording);
  if (recording.recorded_end) {
    if (const std::string lacks = why_not_whole(recording); !lacks.empty()) return lacks;
  } else if (!partial) {
    return "it has no end record: it was cut short, or something was dropped (--partial verifies what there is)";
  }
  if (played.checkpoints < static_cast<long>(recording.checkpoints.size()))
    return fmt::format("only {} of its {} checkpoints were reached", played.checkpoints, recording.checkpoints.size());
  return "";
}

}  // namespace

long told_checkpoints(const Scene& recording) {
  const auto& end = recording.recorded_end;
  return end && end->checkpoints ? *end->checkpoints : static_cast<long>(recording.checkpoints.size());
}

Verification verify(const Scene& recording, const ReplayResult& played, bool partial) {
  Verification result;
  result.reason = why_not(recording, played, partial);
  result.passed = result.reason.empty();
  if (result.passed && recording.recorded_by.format == 1)
    result.warning =
        "it was recorded in format 1, whose end does not prove that nothing is missing; replay it with --record to "
        "have it in format 2";
  return result;
}

}  // namespace heml
