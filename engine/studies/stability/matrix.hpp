#pragma once
// The survival matrix: cases down, law × precision × integrator across, a letter and a colour a cell; laws in two
// panels.
//
//                  stvk                        neo_hookean
//                  double        float         double   …
//                  SE VV BE B2 TR ST SE VV …
//   1 force = −∇U  [      S        ][    s …      a cell over all integrators: forces alone
//   9 beam drop     I  S        …                 capital letters: promised
#include <string>
#include <studies/stability/study.hpp>

namespace heml::stability {

/// An SVG picture.
std::string matrix_svg(const std::vector<Cell>& cells);

}  // namespace heml::stability
