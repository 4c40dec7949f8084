#pragma once
// Tissue colours by region.
#include <heml/math/types.hpp>

namespace heml::render {

/// Linear RGB of a region's tissue: 0 and 1 parenchyma (brown-red), 2 vessels (paler), others from a small palette.
Vec3f tissue_tint(int region);

}  // namespace heml::render
