#pragma once
// What the rows of the table of commands (command_table.hpp) are made of. A row is a specialisation of Row:
//
//   key, meaning, example, value_form, and where they apply unit, keys, tool, takes_up    as CommandInfo says
//   static Command read(const JsonCursor& value, Points& points)     the first row of a key
//   static Json write(const C& command)
//   static References references(C& command)                          of commands that name nodes or elements
#include <fmt/format.h>

#include <heml/scenario/command_table.hpp>

namespace heml::command_rows {

using Points = std::vector<Vec3>;
using References = std::vector<MeshReference>;
inline constexpr auto node_kind = MeshReference::Kind::node;

inline constexpr ValueForm true_form = form::other("`true`"), object_form = form::other("object");
inline constexpr KeyInfo node_row{"node", form::whole(0), "", "one of `node`, `point`",
                                  "in the order of the mesh file"};
inline constexpr KeyInfo point_row{"point", form::vector, "m", "one of `node`, `point`",
                                   "the node of the surface nearest to it at rest"};
inline constexpr KeyInfo radius_row{"radius", form::non_negative, "m", "",
                                    "surface nodes so near at rest belong to it; 0: that node alone"};
inline constexpr KeyInfo hand_row{"hand", form::whole(0, max_hands - 1), "", "`0`",
                                  "which: each holds one patch, and all hold at once; 0, 14 and 15 are a person's"};
inline constexpr KeyInfo hidden_row{"hidden", form::other("list of whole numbers"), "", "none",
                                    "regions that are left out: the surface is that of the others"};
inline constexpr KeyInfo patch_keys[] = {node_row, point_row, radius_row, hidden_row};

/// What most rows have in common. Rows hide what they have of their own.
struct CommonRow {
  static constexpr std::string_view unit = "";
  static constexpr std::span<const KeyInfo> keys = {};
  static constexpr std::optional<CommandTool> tool = {};
  static constexpr bool takes_up = false;
};

/// One for each alternative of Command.
template <class C>
struct Row;

inline void expect_true(const JsonCursor& key) {
  if (!key.flag()) key.refuse("must be true, or leave the entry out");
}

}  // namespace heml::command_rows
