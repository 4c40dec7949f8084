#pragma once
// Geometric stiffness of a self-contact pair. Its point slides over a face, or two edges along each other, while what
// it slides on tilts:
//
//        ●  u: the one side's travel past the other, along the surface
//     ───┴────────── e₁, e₂: the face's edges at a corner, or the two edges of the pair
//
// With the dual vectors e¹, e² in the surface (eⁱ·eⱼ = 1 where i = j, else 0) and the normal n, the gap changes in
// second order by −(e¹·u)(n·δe₁) − (e²·u)(n·δe₂), up to terms as small as the gap. So a force N of the contact has the
// stiffness N Σ (aᵢ bᵢᵀ + bᵢ aᵢᵀ), aᵢ·δx = eⁱ·u and bᵢ·δx = n·δeᵢ. It is indefinite: each product is the difference of
// two squares, 2 a b = ½ (a s + b/s)² − ½ (a s − b/s)², of which those taken away are as large as those added.
#include <heml/dynamics/objective.hpp>
#include <heml/tools/contact_pair.hpp>

namespace heml {

/// Adds the terms of a pair's point with its nodes at x (m). side: ContactPair::side. force: N, of the contact.
void add_pair_slides(int side, const ContactPoint& point, const std::array<Vec3, 4>& x, double force,
                     std::vector<RankOneTerm>& out);

}  // namespace heml
