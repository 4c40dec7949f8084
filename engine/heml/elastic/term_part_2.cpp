#include <heml/elastic/term_part_definition.hpp>

namespace heml {
HEML_TERM_PART(2);
}  // namespace heml
