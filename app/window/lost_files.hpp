#pragma once
// Scenes whose files or folders go away while they are open. They can be saved all the same:
//
//    start() ──► hold_files(): whole paths, the mesh in memory
//    save ─────► keep_lost_files(): the mesh beside the scene, where its file is gone
#include <heml/scenario/scene.hpp>
#include <string>

namespace heml::window {

/// Reads the mesh of a scene's file into memory and makes the paths of its files absolute, which they cannot be made
/// once the working folder is gone. Quadratic elements are read again from the file where they are needed, since the
/// mesh in memory has no nodes on edges. Throws InputError as read_mesh_source().
void hold_files(Scene& scene);

/// Where the file of the mesh is gone, writes the mesh held in memory into a file of unused_path() and makes it the
/// scene's. Returns what is to be told of files that are gone: sentences, or nothing. Throws InputError.
std::string keep_lost_files(Scene& scene);

}  // namespace heml::window
