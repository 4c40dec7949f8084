#include <algorithm>
#include <array>
#include <heml/scenario/body_rows.hpp>
#include <heml/scenario/command_table.hpp>
#include <heml/scenario/tool_rows.hpp>

namespace heml {
namespace {

using command_rows::Row;

template <class C>
bool takes_up(const Command& command) {
  if constexpr (requires(const C& c) { Row<C>::takes_up(c); })
    return Row<C>::takes_up(std::get<C>(command));
  else
    return Row<C>::takes_up;
}

template <class C>
std::vector<MeshReference> references_of(Command& command) {
  if constexpr (requires(C & c) { Row<C>::references(c); })
    return Row<C>::references(std::get<C>(command));
  else
    return {};
}

template <class C>
constexpr CommandInfo info() {
  CommandInfo row{Row<C>::key,
                  Row<C>::meaning,
                  Row<C>::example,
                  Row<C>::value_form,
                  Row<C>::unit,
                  Row<C>::keys,
                  is_edit_command<C>,
                  Row<C>::tool,
                  takes_up<C>,
                  nullptr,
                  [](const Command& command) { return Row<C>::write(std::get<C>(command)); },
                  references_of<C>};
  if constexpr (requires { &Row<C>::read; }) row.read = Row<C>::read;
  return row;
}

template <class... C>
constexpr auto table_of(const std::variant<C...>*) {
  return std::array{info<C>()...};
}
constexpr auto commands = table_of(static_cast<const Command*>(nullptr));

constexpr bool is_first_of_its_key(std::size_t row) {
  for (std::size_t k = 0; k < row; ++k)
    if (commands[k].key == commands[row].key) return false;
  return true;
}

constexpr std::size_t key_count = [] {
  std::size_t count = 0;
  for (std::size_t k = 0; k < commands.size(); ++k) count += is_first_of_its_key(k) ? 1 : 0;
  return count;
}();

/// Keys that messages list last: those that put the whole body back.
constexpr std::string_view last_keys[] = {"undo", "history", "reset"};
constexpr bool is_last(std::string_view key) {
  return std::find(std::begin(last_keys), std::end(last_keys), key) != std::end(last_keys);
}

constexpr auto keys_once = [] {
  std::array<std::string_view, key_count> keys;
  std::size_t next = 0;
  for (std::size_t k = 0; k < commands.size(); ++k)
    if (is_first_of_its_key(k) && !is_last(commands[k].key)) keys[next++] = commands[k].key;
  for (const std::string_view key : last_keys) keys[next++] = key;
  return keys;
}();

static_assert([] {
  for (std::size_t k = 0; k < commands.size(); ++k) {
    const CommandInfo& row = commands[k];
    if (row.key.empty() || row.meaning.empty() || row.example.empty() || !is_complete(row.keys)) return false;
    if (is_first_of_its_key(k) != (row.read != nullptr)) return false;
  }
  return true;
}());

constexpr ToolInfo tool_infos[] = {
    {CommandTool::grasp, "grasp",
     "a spring at each node in reach; explicit steps look at their limit every other step meanwhile"},
    {CommandTool::probe, "probe",
     "meets faces of the surface; explicit steps look at their limit every other step meanwhile"},
    {CommandTool::pin, "pin", "nodes constrained where they are"},
    {CommandTool::suture, "suture", "a stiff link that is drawn in"},
    {CommandTool::tables, "tables", "other planes from then on"},
    {CommandTool::cut, "cut", "elements are split, and the layout of the body is rebuilt"},
    {CommandTool::cautery, "cautery",
     "elements are split as by a cut, and rest shapes shrink; the layout of the body is rebuilt there"},
    {CommandTool::removal, "removal", "loops ask which elements are there"},
    {CommandTool::undo, "undo",
     "the body as it was before the last cut or removal; the state before each action is kept for `history`"},
};

}  // namespace

std::span<const ToolInfo> tool_table() { return tool_infos; }

std::span<const CommandInfo> command_table() { return commands; }

const CommandInfo& info_of(const Command& command) { return commands[command.index()]; }

const CommandInfo& command_with(std::string_view key) {
  return *std::find_if(commands.begin(), commands.end(), [&](const CommandInfo& row) { return row.key == key; });
}

std::span<const std::string_view> event_keys() { return keys_once; }

}  // namespace heml
