#pragma once
// What is remembered between starts.
#include <filesystem>
#include <vector>

namespace heml::window {

/// The user's folder for what programs remember, $XDG_STATE_HOME/heml or ~/.local/state/heml, which need not exist;
/// empty where there is no such place.
std::filesystem::path state_folder();

/// Files that were opened, the latest first, twenty at most; those that have gone meanwhile too.
std::vector<std::filesystem::path> recent_files();

/// Puts a file first among them. Says nothing where that cannot be written.
void remember_file(const std::filesystem::path& path);

}  // namespace heml::window
