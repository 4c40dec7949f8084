#include <heml/scenario/command_table.hpp>
#include <heml/session/undo_list.hpp>

namespace heml {
namespace {

std::vector<std::string> action_names(const std::vector<Command>& actions) {
  std::vector<std::string> names;
  for (const Command& action : actions) names.emplace_back(info_of(action).key);
  return names;
}

std::vector<Command> settings_of(const WorldSetup& setup) {
  std::vector<Command> settings;
  for (const RegionMaterial& entry : setup.materials) settings.emplace_back(SetMaterial{entry.region, entry.material});
  settings.emplace_back(SetGravity{setup.gravity});
  settings.emplace_back(SetDamping{setup.solver.damping});
  settings.emplace_back(SetIntegrator{setup.solver.integrator});
  if (!setup.solver.step) settings.emplace_back(SetRate{setup.solver.rate});
  if (const auto& budget = setup.solver.budget; budget && budget->iterations > 0)
    settings.emplace_back(SetBudget{budget->iterations});
  return settings;
}

}  // namespace

std::shared_ptr<const UndoList> updated(std::shared_ptr<const UndoList> last, const World& world,
                                        const Command& command) {
  const auto* reset = std::get_if<Reset>(&command);
  const bool is_step = std::holds_alternative<StepHistory>(command) || (reset && reset->scene);
  if (last && !is_step && !is_action(command)) return last;
  auto list = std::make_shared<UndoList>();
  const ActionList actions = world.actions();
  list->past = action_names(actions.past);
  list->future = action_names(actions.future);
  list->steps = (last ? last->steps : 0) + (is_step ? 1 : 0);
  if (is_step)
    list->settings = settings_of(world.setup());
  else if (last)
    list->settings = last->settings;
  return list;
}

}  // namespace heml
