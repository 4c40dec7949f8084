#include <cmath>
#include <studies/validation/benchmark.hpp>

namespace heml::validation {

const char* verdict_name(Verdict verdict) {
  constexpr const char* names[] = {"holds", "for comparison", "misses", "fails"};
  return names[static_cast<std::size_t>(verdict)];
}

double Row::error() const { return std::abs(ours - reference) / std::abs(reference); }

Verdict Row::verdict() const {
  if (!failed.empty()) return Verdict::fails;
  if (std::isnan(limit)) return Verdict::compared;
  return error() <= limit ? Verdict::holds : Verdict::misses;  // not a number: misses
}

std::span<const Benchmark> benchmarks() {
  static const Benchmark list[] = {
      {"sphere", "Thick-walled sphere",
       "A sphere with radii 10 and 20 mm, neo-Hookean with a volume term (`neo_hookean_iso`), under pressure inside "
       "that "
       "stretches the inner wall by about a quarter. Three nodes of the outer wall are held where the "
       "reference "
       "has them, against rigid motion.",
       "The equation of balance along the radius, integrated to round-off; at κ → ∞ it agrees with the closed form of "
       "an "
       "incompressible sphere.",
       "Radius at rest, m", "Radial displacement", "m", thick_sphere},
      {"cylinder", "Thick-walled cylinder",
       "A tube with radii 10 and 20 mm in plane strain: both ends are held where the reference has them. Displacements "
       "are those at the middle of its height.",
       "The equation of balance along the radius, integrated to round-off.", "Radius at rest, m", "Radial displacement",
       "m", thick_cylinder},
      {"elastica", "Elastica",
       "A cantilever 100 times as long as deep, under a dead load F across its end; Poisson's ratio 0.",
       "Inextensible beam without shear: E I θ'' = −F cos θ. Tables: Bisshopp & Drucker 1945, Mattiasson 1981.",
       "Along the beam at rest, m", "Deflection", "m", elastica},
      {"cook", "Cook's membrane",
       "48 mm wide, 44 mm high at the clamp, 16 mm at the other end, 10 mm thick with free faces; `neo_hookean_iso` of "
       "4 "
       "kPa; a dead traction of 0.02 N in all lifts the end by 4 mm. The upper corner, at half the thickness.",
       "CalculiX, 20-node hexahedra with reduced integration, 8, 12 and 16 a side, extrapolated with the order that "
       "they "
       "show (`assets/make/cook_reference.py`); certain to about 0.1 % at ν 0.3 and 0.3 % at ν 0.499.",
       "Unknowns", "Rise of the upper corner", "m", cook_membrane},
      {"relaxation", "Relaxation after a step",
       "A block is sheared by 0.3 at once and held; two branches of relaxation (0.1 and 0.5 s).",
       "G(t)/G∞ = 1 + Σ γ exp(−t/τ), times μ γ of the neo-Hookean law. Methods spread the jump over their first step, "
       "as if it had come half a step later: an error of about h/2τ.",
       "Time, s", "Shear stress", "Pa", relaxation},
      {"creep", "Creep under a constant stress",
       "A block between rollers is drawn by a stress of 10 Pa, applied at once; one branch of relaxation in shear "
       "(γ 1, 0.1 s), an elastic bulk.",
       "σ J(t)/3 + σ/9κ with the compliance J(t) = (1 − γ/(1+γ) exp(−t/(τ(1+γ))))/G∞ of the linear solid; the strain "
       "is about 0.001.",
       "Time, s", "Strain", "m/m", creep},
      {"viscous_loop", "Cycles of a relaxing solid",
       "A block is sheared to and fro by 0.02 at constant speed, 0.4 s a cycle; two branches of relaxation (0.1 and "
       "0.5 s). The third cycle.",
       "The Prony series, integrated exactly over each step.", "Shear", "Shear stress", "Pa", viscous_loop},
      {"plastic_cycle", "Cycles of a yielding solid",
       "A block is sheared to and fro by 0.02, four times the shear at which it yields; von Mises plasticity with "
       "linear isotropic hardening.",
       "Return mapping in one dimension, exact for linear hardening at small strains.", "Shear", "Shear stress", "Pa",
       plastic_cycle},
      {"hertz", "A ball pressed into a block",
       "A rigid ball (radius 20 mm) is pressed by 0.5 to 4 mm into a cylinder (radius and height 40 mm, neo-Hookean, ν "
       "0.3) on a base that holds it, without friction; a quarter of it, backward Euler with steps of a second.",
       "Axisymmetric elements of nine nodes (`assets/make/hertz_reference.py`), certain to about 0.2 %; Hertz's "
       "formula "
       "is of a body without ends.",
       "Depth, m", "Force", "N", ball_contact},
      {"land_beam", "Land's beam (problem 1)",
       "A beam of 10 × 1 × 1 mm of heart muscle, fibres along it (`guccione` with C 2 kPa, bf 8, bt 2, bfs 4), clamped "
       "at one end. A pressure of 4 Pa on its lower face follows the deformed face.",
       "Land et al. 2015, problem 1: codes of eleven groups. The consensus, 4.17 mm, of solutions between 4.15 and "
       "4.19 mm, is as others quote it, not read from the paper's own figure 3.",
       "Unknowns", "Height of the end", "m", land_beam},
      {"land_ventricle", "Land's ventricle (problem 2)",
       "An ellipsoid cut at the base, 3 mm thick, isotropic (`guccione` with C 10 kPa, bf = bt = bfs = 1), is held "
       "at its base and blown up by a pressure of 10 kPa inside, which follows the deformed wall. Ours is the limit of "
       "two solutions with κ 1 and 2 MPa, whose difference falls with 1/κ. Strains are changes of distances in the "
       "middle of the wall, as in the paper.",
       "Land et al. 2015, problem 2: codes of eleven groups. The consensus of its figures 6 (to about 0.2 mm) and "
       "8 (to about 2 %) is as others quote it, the strains as TorchCor has them (github.com/sagebei/torchcor).",
       "Station from apex to base", "Strain", "%", land_ventricle},
      {"land_contraction", "Land's contracting ventricle (problem 3)",
       "The same ellipsoid of heart muscle (`guccione` with C 2 kPa, bf 8, bt 2, bfs 4), whose fibres turn from 90° "
       "inside to −90° outside, contracts with an active stress of 60 kPa against a pressure of 15 kPa inside; both "
       "grow together. Fibres are a field with a direction an element. Ours is the limit of κ, as in problem 2.",
       "Land et al. 2015, problem 3: the refined solution of one participant (FEniCS), −12.347 and −15.452 mm, as "
       "TorchCor has it (github.com/sagebei/torchcor, torchcor/mechanics/benchmark/land/p3.py); not the paper's figure "
       "9 itself, and no mean of all codes.",
       "Unknowns", "z of the apex", "m", land_contraction},
  };
  return list;
}

}  // namespace heml::validation
