#pragma once
// What a step has gained in energy is taken back: implicit methods of second order gain some where a step is long for
// what it passes, and iterates that are no solution may gain any amount. The motion of free parts as a whole is spared
// as long as there is other energy to take (rigid_motions.hpp), since nothing inside a body can change it.
#include <heml/world/simulation.hpp>

namespace heml {

/// J. v: 3 #V, m/s; of coordinates that are not held.
template <class Real>
double kinetic_energy(const ImplicitState<Real>& parts, const Vector& v);

/// Leaves v (m/s, at x, m) so much kinetic energy, J, and takes the rest from the motion within parts first. s.implicit
/// must exist.
template <class Real>
void slow_down(const Simulation<Real>& s, double left, const Vector& x, Vector& v);

/// After a converged step of h, s, by a method of second order to x at a time, s: takes what it gained from v, which is
/// an error of third order in the step, as the method's own. Returns false where v has less. Known where nothing but
/// loads with a potential does work, and nothing flows.
template <class Real>
bool take_back_gain(Simulation<Real>& s, double h, double time, const Vector& x, Vector& v);

/// After a step of h, s, to any iterate x: takes from x, v what they have gained beyond the work of the loads: from the
/// velocity while that has it to give, else by going back towards the start, moved as a whole where that will do. Held
/// nodes that move do work of their own, and pressure that follows the surface has no potential: nothing is known
/// there, and nothing done. Yet where the step has failed otherwise (`always`) it is limited there too: to the energy
/// with supports moved and all else as at the start; under pressure, to the kinetic energy of the start. Returns
/// whether x or v may have changed.
template <class Real>
bool limit_energy(Simulation<Real>& s, double h, double time, bool always, Vector& x, Vector& v);

}  // namespace heml
