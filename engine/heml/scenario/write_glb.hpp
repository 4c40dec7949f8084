#pragma once
// Animated surfaces as one binary glTF file (.glb), which Blender and viewers of the web open.
#include <filesystem>
#include <functional>
#include <heml/scenario/animation.hpp>
#include <map>
#include <string>

namespace heml {

struct GlbStyle {
  std::function<Vec3f(int region)> colour;    ///< linear RGB
  std::map<int, std::string> region_names{};  ///< names of the materials
};

/// Writes glTF 2.0 (Khronos Group, glTF 2.0 Specification, 2021), metres, y up:
///
///   frames     morph targets of the first one, positions and normals; at the time of frame k the weight of target k
///              is 1 and all others are 0, linear between: nodes move on straight lines from frame to frame
///   regions    a primitive each, with a material of its colour and name
///   edits      a node and mesh each part; the others are scaled to nothing meanwhile
///
/// Needs an animation of surfaces (Animation::Extent::surface). Throws InputError when the file would exceed 4 GB or
/// cannot be written.
void write_glb(const std::filesystem::path& path, const Animation& animation, const GlbStyle& style);

}  // namespace heml
