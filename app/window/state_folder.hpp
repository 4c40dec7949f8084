#pragma once
// Files kept between runs of the program.
#include <app/panel/camera_controller.hpp>
#include <app/panel/preferences.hpp>
#include <filesystem>
#include <vector>

namespace heml::window {

/// The user's state folder, $XDG_STATE_HOME/heml or ~/.local/state/heml, which need not exist; empty if neither
/// variable is set.
std::filesystem::path state_folder();

/// Recently opened files, latest first, 20 at most; some may no longer exist.
std::vector<std::filesystem::path> recent_files();

/// Puts a file first in that list. Does nothing if the list cannot be written.
void remember_file(const std::filesystem::path& path);

/// Whether the section of a bare mesh was folded away for this file.
bool is_mesh_folded(const std::filesystem::path& mesh);
/// Remembers it, with the 100 files before. Does nothing if that cannot be written.
void remember_mesh_folded(const std::filesystem::path& mesh, bool folded);

/// The camera views saved with a scene file; none where nothing was written or can be read.
panel::CameraController::SavedViews saved_views(const std::filesystem::path& scene);
/// Writes them, with those of the 100 scenes written before. Does nothing if they cannot be written, or without a file.
void remember_views(const std::filesystem::path& scene, const panel::CameraController::SavedViews& views);

/// What the panel remembers; as at first where nothing was written or can be read.
panel::Preferences read_preferences();
/// Does nothing if it cannot be written.
void write_preferences(const panel::Preferences& preferences);

}  // namespace heml::window
