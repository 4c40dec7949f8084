#pragma once
// Names of the scenes that come with the program, so that they can be given without their folder.
#include <string>

namespace heml {

/// "cantilever", or "extreme/stab" of a folder of scenes, becomes the path of the installed scene of that name, unless
/// there is a file or folder of that path here. Throws InputError for a name that misspells one by a letter in four.
/// Anything else is returned as given.
std::string scene_path(const std::string& given);

}  // namespace heml
