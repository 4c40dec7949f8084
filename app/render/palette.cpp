#include "app/render/palette.hpp"

#include <array>

namespace heml::render {

Vec3f tissue_tint(int region) {
  const std::array<Vec3f, 6> tints = {Vec3f(0.195f, 0.036f, 0.026f),  // parenchyma
                                      Vec3f(0.31f, 0.085f, 0.072f),   // vessels
                                      Vec3f(0.66f, 0.42f, 0.24f),     // fat
                                      Vec3f(0.54f, 0.29f, 0.27f),     // pelvis, ducts
                                      Vec3f(0.35f, 0.10f, 0.12f),     // dark parenchyma
                                      Vec3f(0.58f, 0.36f, 0.34f)};    // fibrous tissue
  if (region <= 1) return tints[0];
  return region == 2 ? tints[1] : tints[2 + static_cast<std::size_t>(region - 3) % 4];
}

}  // namespace heml::render
