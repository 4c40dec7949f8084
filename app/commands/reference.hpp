#pragma once
// The reference pages, made from the tables by which the program reads what they describe.
#include <CLI/CLI.hpp>
#include <string>

namespace heml {

std::string commands_page(const CLI::App& program);  ///< app/docs/commands.md
std::string scene_page();                            ///< app/docs/scene-format.md
std::string laws_page();                             ///< engine/docs/laws.md

}  // namespace heml
