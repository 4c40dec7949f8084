#pragma once
// Undo and redo of what a person does: the whole state before each action, and the states that were left by undo.
//
//    past:    before grasp │ before cut │ before pin          now          future: as left by undo, latest first
//
// An action is a command that begins something (is_action): a grasp with all its moves, a stroke with all its sweeps,
// a drag of a slider. Only the last actions are kept, bounded in number and in memory.
#include <heml/world/command.hpp>
#include <heml/world/mesh_editor.hpp>
#include <heml/world/simulation_snapshot.hpp>

namespace heml {

/// A simulation's data and its edits to undo at one moment.
template <class Real>
struct Moment {
  SimulationSnapshot<Real> simulation;
  EditHistory<Real> edits;
};

/// Values that snapshots of a world copy.
template <class Real>
struct ActionLists {
  struct Entry {
    std::shared_ptr<const Moment<Real>> moment;
    Command action;  ///< that the moment came before
  };
  std::vector<Entry> past, future;  ///< oldest first; next to redo last
  std::optional<Command> last;      ///< command that the newest action continues with
  long last_tick = 0;               ///< of `last`
};

template <class Real>
class ActionHistory {
 public:
  static constexpr std::size_t max_actions = 20, max_bytes = std::size_t{512} << 20;

  /// Whether a command begins an action: it is one, and goes on with none. seconds_per_tick: s.
  bool begins_action(const Command& command, long tick, double seconds_per_tick, bool has_probe) const;

  /// Adds an action that was carried out. before: null where it goes on with the last one.
  void carried_out(const Command& command, long tick, std::shared_ptr<const Moment<Real>> before);

  /// The moment to return to, one action back (by < 0) or forth; null: there is none. now: the state that is left.
  std::shared_ptr<const Moment<Real>> step(int by, std::shared_ptr<const Moment<Real>> now);
  bool can_step(int by) const { return !(by < 0 ? lists_.past : lists_.future).empty(); }

  const ActionLists<Real>& lists() const { return lists_; }
  /// Of a snapshot that the world was restored to.
  void restore(const ActionLists<Real>& lists) { lists_ = lists; }
  std::size_t bytes() const;

 private:
  ActionLists<Real> lists_;
};

}  // namespace heml
