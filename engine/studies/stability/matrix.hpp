#pragma once
// The survival matrix: one row per case, one column per law × precision × integrator, a letter and a colour per cell;
// laws in two panels.
//
//                  stvk                        neo_hookean
//                  double        float         double   …
//                  SE V  BE B2 TR ST SE V  …
//   1 force = −∇U  [      S        ][    s …      one cell over all integrators: forces only
//   9 beam drop     I  S        …                 capital letters: promised cells
#include <string>
#include <studies/stability/study.hpp>

namespace heml::stability {

/// An SVG picture.
std::string matrix_svg(const std::vector<Cell>& cells);

}  // namespace heml::stability
