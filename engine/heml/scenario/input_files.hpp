#pragma once
// Checks that a run does not overwrite its own input files.
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <string_view>
#include <vector>

namespace heml {

/// The files of a scene: its own, its mesh or surface, its initial positions. They need not exist.
std::vector<std::filesystem::path> input_files(const Scene& scene);

/// Frames of an earlier run in a folder: frame_<number>.<ending>.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder, std::string_view ending);

/// Throws InputError where an output is the same file as an input, under any name. Call before computing. outputs:
/// files that will be replaced or removed; they need not exist. option: named in the remedy.
void refuse_overwriting(const std::vector<std::filesystem::path>& inputs,
                        const std::vector<std::filesystem::path>& outputs, std::string_view option = "--out");

/// Throws InputError where the output is one of the inputs or cannot be written. Call before computing.
void check_output_file(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& output,
                       std::string_view option = "--out");
/// The same for a folder; outputs: the files in it.
void check_output_folder(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& folder,
                         const std::vector<std::filesystem::path>& outputs, std::string_view option = "--out");

}  // namespace heml
