#include <heml/base/upwards.hpp>
