// The table of cases.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <studies/stability/case.hpp>

namespace heml::stability {
namespace {

/// Names of all laws without stress at rest that satisfy a predicate.
std::vector<std::string_view> laws_where(bool (*predicate)(const LawInfo&)) {
  std::vector<std::string_view> names;
  for (const LawInfo& law : heml::laws())
    if (law.is_stress_free && predicate(law)) names.push_back(law.name);
  return names;
}

bool has_exponent(const LawInfo& law) {
  return std::any_of(law.parameters.begin(), law.parameters.end(),
                     [](const ParameterInfo& info) { return info.kind == ParameterKind::exponent; });
}

const auto laws = laws_where([](const LawInfo&) { return true; });
const auto solids = laws_where([](const LawInfo& law) { return law.is_continuum; });
const auto exponentials = laws_where(has_exponent);
const auto principal_laws = laws_where([](const LawInfo& law) { return law.is_principal; });
const auto with_volume_term = laws_where([](const LawInfo& law) { return law.has_volume_term && !law.has_fibre; });
const std::vector<std::string_view> a_few = {"stvk", "neo_hookean", "mooney_rivlin", "mass_spring"};  // a long case
constexpr double not_run = std::numeric_limits<double>::quiet_NaN();

using enum Integrator;
std::vector<Integrator> with_statics() {
  std::vector<Integrator> list = moving_integrators();
  list.push_back(static_equilibrium);
  return list;
}
const std::vector<Integrator> none, explicits = explicit_integrators(), implicits = implicit_integrators(),
                                    moving = moving_integrators(), every = with_statics();

// clang-format off
const std::vector<Case>& table() {
  static const std::vector<Case> cases = {
      {1, "force = −∇U", "forces are minus the gradient of the energy, with elements inside out too",
       "error / largest force", 1e-6, 1e-5, laws, none, {"01_force"}, force_is_energy_gradient},
      {2, "stiffness = −∂f/∂x", "stiffness is minus the gradient of the forces, with elements inside out too",
       "error / largest change", 1e-5, 1e-5, laws, none, {"02_stiffness"}, stiffness_is_force_gradient},
      {3, "tension form", "forces are those of the form with deformation gradients, written apart from the engine",
       "difference / largest force", 1e-10, 1e-5, laws, none, {"03_tension_form"}, tension_form_is_gradient_form},
      {4, "rigid, 10 km away", "a body turned and carried 10 km from the origin feels nothing",
       "largest force / E L²", 1e-9, 1e-9, laws, none, {"04_ten_km_away"}, rigid_motion_far_away},
      {5, "sums of forces", "forces have no sum and no moment",
       "sum / sum of sizes", 1e-12, 1e-6, laws, none, {"05_sums_of_forces"}, sums_of_forces},
      {6, "patch test", "inner nodes of an irregular mesh find the affine shape of its surface",
       "largest error / side", 1e-10, 2e-5, solids, every, {"06_patch"}, patch},
      {7, "order of Verlet", "halving the step quarters the error",
       "|order − 2|", 0.1, not_run, laws, {verlet}, {"07_order_of_verlet"}, order_of_verlet},
      {8, "order of TR-BDF2", "halving the step quarters the error",
       "|order − 2|", 0.2, not_run, laws, {tr_bdf2}, {"08_order_of_tr_bdf2"}, order_of_tr_bdf2},
      {9, "beam drop", "a beam of 10 kPa falls at the live limit and keeps its energy; at the limit at rest it does not",
       "energy lost or won / swing", 0.01, 0.01, laws, explicits, {"09_beam_drop"}, beam_drop},
      {10, "energy drift", "undamped, over a second",
       "drift / swing", 1e-5, 1e-3, laws, explicits, {"10_energy_drift"}, energy_drift},
      {11, "no energy from nothing", "let go from four shapes, nobody works on it, and its energy never rises",
       "largest rise in a step / energy", 1e-9, 1e-5, solids, implicits,
       {"11_stretched", "11_compressed", "11_thinned", "11_twisted"}, no_energy_from_nothing},
      {12, "any budget", "the same from disorder too, with 1 or 3 iterations a step, by both minimisers",
       "largest rise in a step / energy", 1e-6, 1e-6, solids, implicits,
       {"11_stretched", "11_compressed", "11_twisted", "12_shaken"}, no_energy_from_budgets},
      {13, "collapse", "from a point, a line, a plane and random scatter, ν 0.3 to 0.499, back to rest in 60 steps",
       "rms / size", 1e-3, 1e-3, solids, moving, {"13_point", "13_line", "13_plane", "13_scatter"}, collapsed},
      {14, "flattened", "pressed flat and beyond, with the law continued, it pushes back harder all the way",
       "heights at which it does not", 0, 0, solids, {backward_euler}, {"14_flattened"}, flattened},
      {15, "mirrored", "with one half mirrored into the other, ν 0.3 to 0.499, back to rest in 60 steps",
       "rms / size", 1e-3, 1e-3, solids, moving, {"15_mirrored"}, mirrored},
      {16, "× 5 and × 0.2", "stretched to five times its length, pressed to a fifth",
       "iterations", 60, 60, laws, {static_equilibrium}, {"16_stretched_five_times", "16_pressed_to_a_fifth"},
       stretched_and_pressed},
      {17, "half a turn", "wrung by 180° in 20 steps",
       "iterations in a step, at most", 8, 8, laws, implicits, {"17_half_a_turn"}, half_a_turn},
      {18, "two turns", "wrung by 720°: it never has more energy than the turning end has put in",
       "steps in which it has", 0, 0, laws, implicits, {"18_two_turns"}, two_turns},
      {19, "stiffness 1 : 10⁶", "a half a million times stiffer is as good as rigid",
       "difference / motion", 1e-4, 1e-2, laws, {static_equilibrium}, {"19_stiff_half"}, stiffness_ratio},
      {20, "1 GPa, 20 ms", "settles on its equilibrium",
       "error / sag", 0.01, 0.01, laws, implicits, {"20_stiff_settles"}, stiff_and_settled},
      {21, "ν = 0.499", "with nodal pressure it sags like ν = 0.3 and keeps its volume to 0.5 %",
       "difference / sag", 0.12, 0.12, with_volume_term, {static_equilibrium}, {"21_nearly_incompressible"},
       nearly_incompressible},
      {22, "sliver", "explicit: the step is stable, and the element that shortens it named; implicit: nothing changes",
       "explicit: step over the longest stable one, beyond 0.9; implicit: difference / sag", 0.05, 0.05, laws, moving, {"22_sliver"}, sliver},
      {23, "density 1 : 10⁴", "explicit and implicit steps agree",
       "difference / motion", 0.01, 0.01, laws, {verlet, tr_bdf2}, {"23_heavy_half"}, density_ratio},
      {24, "Q = 200", "exponentials where e^Q overflows: forces are still the gradient of the energy",
       "error / largest force", 1e-6, 1e-5, exponentials, none, {"24_exponential_far_out"}, exponential_far_out},
      {25, "equal stretches", "where directions of stretch are not unique, the stiffness is",
       "error / largest change", 1e-5, 1e-5, principal_laws, none, {"25_equal_stretches"}, equal_stretches},
      {26, "yanked", "a corner pulled at 10 m/s by more than its own length and let go comes back",
       "rms / size", 1e-3, 1e-3, laws, moving, {"26_yanked"}, yanked},
      {27, "jittered steps", "steps of 1 to 40 ms by chance settle on the equilibrium",
       "error / sag", 0.01, 0.01, laws, implicits, {"27_jittered_steps"}, jittered_steps},
      {28, "cut away", "1000 random tetrahedra go, and take their energy and no more",
       "difference / energy", 1e-9, 1e-5, solids, moving, {"28_cut_away"}, cut_away},
      {29, "law switched", "under load: positions stay, energy jumps by the difference of the laws",
       "difference / energy", 1e-9, 1e-5, solids, moving, {"29_law_switched"}, law_switched},
      {30, "permuted", "renumbered, rewound and turned in space, the same motion",
       "difference / size", 1e-9, 1e-5, laws, every, {"30_permuted"}, permuted},
      {31, "other units", "in metres and in millimetres, the same motion",
       "difference / size", 1e-9, 1e-5, laws, every, {"31_other_units"}, other_units},
      {32, "1 to 16 threads", "the same bits",
       "numbers of threads that differ", 0, 0, laws, every, {"32_any_number_of_threads"}, any_number_of_threads},
      {33, "a million steps", "undamped, it keeps its energy",
       "energy lost or won / swing", 1e-5, 1e-4, a_few, {verlet}, {"33_soak"}, soak},
  };
  return cases;
}
// clang-format on

}  // namespace

std::span<const Case> cases() { return table(); }

const Case& case_numbered(int number) {
  const auto& all = table();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.number == number; });
  assert(found != all.end());
  return *found;
}

std::vector<CaseVariant> variants_of(const Case& c, bool quick) {
  static constexpr std::string_view few[] = {"neo_hookean", "mooney_rivlin"};
  std::vector<std::optional<Integrator>> integrators(c.integrators.begin(), c.integrators.end());
  if (integrators.empty()) integrators.emplace_back();
  std::vector<CaseVariant> variants;
  for (const std::string_view law : c.laws)
    for (const bool single : {false, true}) {
      if (single && std::isnan(c.float_limit)) continue;
      const auto wanted = std::span(few).first(single ? 1 : 2);
      if (quick && !c.integrators.empty() && std::find(wanted.begin(), wanted.end(), law) == wanted.end()) continue;
      for (const auto& integrator : integrators) variants.push_back({std::string(law), integrator, single});
    }
  return variants;
}

std::span<const std::string_view> study_laws() { return laws; }
std::span<const std::string_view> continua() { return solids; }

}  // namespace heml::stability
