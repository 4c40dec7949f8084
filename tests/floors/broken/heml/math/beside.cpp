#include <heml/base/upwards.hpp>
#include <studies/bench.hpp>
