#include <heml/math/types.hpp>
