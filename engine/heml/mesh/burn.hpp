#pragma once
// Burning: an electrode coagulates the tissue about its path. Heated collagen contracts, so that an element which is
// coagulated all through is at rest at a part 1 − shrink of its lengths: liver loses 12 to 22 % of its length within 15
// minutes at 60 to 95 °C (Rossmann, Garrett-Mayer, Rattay, Haemmerich 2014), under microwaves 21 to 43 % (Farina et al.
// 2014). How fast, depends exponentially on the temperature (Chen, Wright, Humphrey 1997), so that the highest one
// decides; it falls with the distance from the path:
//
//     level 1 ────────╲              the level of an element is that of its nearest point, so that no path through
//                      ╲             large elements misses all; where paths lie beside each other the highest level
//           0           ╲────────    holds, so that a path passed twice burns as one
//             0     r/2      r  distance
//
// Rest shapes go there in time (contract()), since a sudden change would throw the tissue about.
#include <heml/mesh/edit.hpp>
#include <heml/mesh/sweep.hpp>

namespace heml {

/// The level at a distance (m) from the path.
double burn_level(double distance, double radius);

/// The burns of a mesh, #T, after an electrode has gone along a sweep, whose blades may be points and one alone; scales
/// are as they were. x: deformed positions, #V×3, m, in whose space the sweep and the radius are. Elements that are not
/// in the topology keep theirs.
std::vector<Burn> burns_after(const Heat& heat, const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x,
                              const Topology& topology);

/// Whether any rest shape is not at its end yet.
bool are_contracting(const std::vector<Burn>& burns);

/// Lets rest shapes go on to their end, by at most so much of their first length; infinite: at once.
void contract(std::vector<Burn>& burns, double by);

}  // namespace heml
