#pragma once
// The sizes a PLY file declares, checked against what it holds. assimp believes them: it asks for that much memory or
// counts that far.
#include <string>
#include <string_view>

namespace heml {

/// Whether a file's contents say that they are PLY, whatever the file is called.
bool is_ply(std::string_view text);

/// Throws InputError for a header that is not understood, and where elements or lists are larger than the rest of the
/// file.
void check_ply(std::string file, std::string_view text);

}  // namespace heml
