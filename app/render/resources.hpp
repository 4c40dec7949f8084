#pragma once
// Files compiled into the program: everything in shaders/, and the font.
#include <string_view>

namespace heml::render {

/// The bytes of an embedded file, by its name without folder ("tissue.frag"). Throws std::logic_error for other names.
std::string_view resource(std::string_view name);

}  // namespace heml::render
