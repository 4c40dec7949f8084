#pragma once
// Checks the sizes that a PLY file declares against its length. assimp trusts them: it allocates that much memory or
// loops that often.
#include <string>
#include <string_view>

namespace heml {

/// Whether the contents begin with the PLY signature, whatever the file's name.
bool is_ply(std::string_view text);

/// Throws InputError if the header is invalid, or elements or lists are larger than the rest of the file.
void check_ply(std::string file, std::string_view text);

}  // namespace heml
