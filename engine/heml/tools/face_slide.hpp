#pragma once
// Geometric stiffness of a face that a probe touches. The contact point is the face's point nearest to the probe's
// axis, so it slides as the face tilts:
//
//         ● axis                d   distance of the axis
//         │ d                   u   tilt of the face, a vector along it (per metre of travel)
//     ────┴──── face            t   travel of the material at the point, along the face
//
// The distance changes by −(d u² + 2 u·t)/2 in second order, so a force N of the contact has the stiffness
// N (d u² + 2 u·t) = N d (u + t/d)² − N t²/d: a product of vectors, and one of negative sign. It is no small matter:
// beside the stiffness of the tissue it is as the width of the contact to the size of the face.
#include <heml/dynamics/objective.hpp>
#include <heml/tools/contact_surface.hpp>

namespace heml {

/// Adds the terms of a point of capsule_face_contact() with its corners at x (m): two of negative sign, and one for
/// each way in which the point slides: two inside a face, or on an edge that crosses the middle of the axis; one on an
/// edge nearest to an end, or at a corner beside the axis; none of a face that the axis passes through. force: N, of
/// the contact.
void add_face_slides(const ContactSurface& capsule, const ContactPoint& point, const std::array<Vec3, 3>& x,
                     double force, std::vector<RankOneTerm>& out);

}  // namespace heml
