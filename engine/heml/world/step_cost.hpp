#pragma once
// What an explicit step costs, as a fixed model that knows no clock and no processor: "auto" chooses by it, and must
// choose the same everywhere.
#include <heml/elastic/body.hpp>
#include <heml/world/setup.hpp>

namespace heml {

/// s an element, on one core: the mean over a body's elements of what their laws and other terms take.
double fixed_step_cost(const std::vector<KernelInfo>& kernels, const WorldSetup& setup);

}  // namespace heml
