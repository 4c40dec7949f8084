#pragma once
// What a run reads is never what it writes over.
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <string_view>
#include <vector>

namespace heml {

/// The files a scene is made of: its own, its mesh or surface, its initial positions. None need exist.
std::vector<std::filesystem::path> input_files(const Scene& scene);

/// Frames of an earlier run in a folder: frame_<number>.<ending>.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder, std::string_view ending);

/// To be called before anything is computed. outputs: that will be replaced or taken away, those that exist and those
/// that do not. option: what to name in the remedy. Throws InputError where an output is an input, by whatever name.
void refuse_overwriting(const std::vector<std::filesystem::path>& inputs,
                        const std::vector<std::filesystem::path>& outputs, std::string_view option = "--out");

/// What every command asks before it computes: that its output is none of its inputs and can be written. Throws
/// InputError.
void check_output_file(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& output,
                       std::string_view option = "--out");
/// The same of a folder; outputs: the files in it.
void check_output_folder(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& folder,
                         const std::vector<std::filesystem::path>& outputs, std::string_view option = "--out");

}  // namespace heml
