#pragma once
// Every key of a scene file that is no event: the one list, which readers check by and the reference page is printed
// from. Events are in command_table.hpp, parameters of laws in materials/law_list.hpp.
#include <heml/dynamics/solver_options.hpp>
#include <heml/materials/material.hpp>
#include <heml/scenario/key_table.hpp>
#include <heml/scenario/solver_json.hpp>
#include <heml/scenario/standard_view.hpp>
#include <heml/scenario/view_json.hpp>
#include <heml/world/field_list.hpp>

namespace heml {

/// An object of a scene file.
struct ObjectInfo {
  std::string_view path;  ///< where it stands: "solver.budget", "boundary[]"; "": the whole
  std::string_view meaning;
  std::span<const KeyInfo> keys;  ///< in the order in which messages list them
  std::string_view example;  ///< JSON merge patch of the smallest scene: with such an object, no more than required
};

namespace scene_keys {

inline constexpr std::string_view none = "none";
inline constexpr ValueForm region = form::whole(std::numeric_limits<int>::min());
inline constexpr ValueForm count = form::whole(0);
inline constexpr ValueForm object = form::other("object"), objects = form::other("list of objects");
inline constexpr ValueForm quantity = form::other("number, or `{\"field\": NAME}`");
inline constexpr ValueForm hash = form::other("16 hexadecimal digits");

inline constexpr std::string_view one_mesh = "one of `file`, `surface`, `box`, `asset`";
inline constexpr std::string_view one_selection = "one of `nodes`, `box`, `sphere`";
inline constexpr std::string_view one_elements = "one of `tets`, `region`, `box`, `sphere`";
inline constexpr std::string_view one_load = "one of `force`, `traction`, `pressure`";
inline constexpr std::string_view one_motion = "`fix`, or `translate` and `rotate` or one of them";
inline constexpr std::string_view one_parameters = "with `poisson`, in place of `lambda` and `mu`";

inline constexpr KeyInfo nodes_row{"nodes", form::other("list of whole numbers ≥ 0"), "", one_selection,
                                   "these nodes, counted from 0 in the order of the mesh file"};
inline constexpr KeyInfo box_row{"box", form::other("`[[x, y, z], [x, y, z]]`"), "m", one_selection,
                                 "nodes in this box at rest: lower corner, upper corner, both included"};
inline constexpr KeyInfo sphere_row{"sphere", form::other("`[[x, y, z], radius]`"), "m", one_selection,
                                    "nodes in this sphere at rest, its surface included"};

inline constexpr KeyInfo friction_row{"friction", form::non_negative, "", "", "Coulomb's coefficient"};

inline constexpr KeyInfo scene[] = {
    {"schema_version", form::other("`1`"), "", required, "version of the format"},
    {"name", form::text, "", none, "for messages and reports"},
    {"title", form::text, "", none, "for the window's list of scenes"},
    {"description", form::text, "", none, "for the window's list of scenes"},
    {"mesh", object, "", required, "the body at rest"},
    {"materials", objects, "", required, "what it is made of, one or more"},
    {"regions", objects, "", "`[]`", "elements that get other regions than the mesh gives them, in this order"},
    {"boundary", objects, "", "`[]`", "supports; of several on one coordinate of a node the last holds"},
    {"loads", objects, "", "`[]`", "forces and pressures; they add up"},
    {"tables", objects, "", "`[]`",
     "planes that the body cannot pass; one that is put where tissue is rises from below it to its place"},
    {"self_contact", form::other("`true`, `false` or object"), "", "`false`", "whether tissue bears on tissue"},
    {"tearing", object, "", none, "where the body comes apart by itself"},
    {"gravity", form::vector, "m/s²", "", "acceleration of all mass"},
    {"solver", object, "", "`{}`", "method, precision, and how they are run"},
    {"outputs", object, "", "`{}`", "what `heml solve` writes"},
    {"initial", object, "", "`{}`", "state at time 0"},
    {"view", object, "", "`{}`", "how the window and frames begin; no part of the physics"},
    {"skin", object, "", none, "a fine surface that is drawn in place of the body's own; no part of the physics"},
    {"events", form::other("list of [events](#events)"), "", "`[]`", "the script: what happens when"},
    {"checkpoints", form::other("list of [checkpoints](#recordings)"), "", "`[]`",
     "states that `replay --verify` compares"},
    {"recorded", object, "", none, "of a recording: with which mesh and build it was made"},
};
inline constexpr KeyInfo mesh[] = {
    {"file", form::text, "", one_mesh,
     "tetrahedra, and bricks, wedges and pyramids, which are divided: `.msh`, `.mesh`, `.vtk`, `.vtu`, `.inp`, `.feb`, "
     "`.node` with `.ele`"},
    {"surface", form::text, "", one_mesh,
     "closed surface, filled with tetrahedra by TetGen: `.obj`, `.stl`, `.ply` ..."},
    {"tetgen", object, "", "`{}`", "how a surface is filled"},
    {"labels", form::text, "", one_mesh,
     "label map of a scan, a region a label: `.nii`, `.nii.gz`, `.nrrd`, `.nhdr`, `.mha`, `.mhd`"},
    {"tets", form::whole(1, 10'000'000), "", "of a label map 20000, else none",
     "wanted number of tetrahedra, met within a quarter where the surface allows; a `file` or `surface` gets better "
     "shapes too (`heml mesh --improve --tets`)"},
    {"box", object, "", one_mesh, "cells of 5 tetrahedra; nodes are numbered along x, then y, then z"},
    {"asset", form::text, "", one_mesh, "a mesh that comes with the program: `\"kidney\"`"},
    {"scale", form::positive, "", "", "multiplies coordinates; before `rotate` and `translate`"},
    {"rotate", object, "", "no rotation", "after `scale`, before `translate`"},
    {"translate", form::vector, "m", "", "after `scale` and `rotate`"},
    {"refine", object, "", none, "makes the mesh finer where its estimated error is greatest"},
};
inline constexpr KeyInfo mesh_box[] = {
    {"size", form::vector, "m", required, "edges, each greater than 0"},
    {"cells", form::other("three whole numbers ≥ 1, at most 2,000,000 in all"), "", required, "cells along each edge"},
    {"origin", form::vector, "m", "", "corner with the smallest coordinates"},
};
inline constexpr KeyInfo tetgen[] = {
    {"radius_edge_ratio", form::between(1, 100), "", "", "shape of tetrahedra: smaller is better and more"},
    {"max_volume", form::positive, "m³", "no limit", "of one tetrahedron, in the body as scaled"},
};
inline constexpr KeyInfo refine[] = {
    {"error", form::between(0.001, 1), "", "", "estimated error to reach, relative, in the energy norm, at rest"},
    {"tets", form::whole(1, 10'000'000), "", "", "no more tetrahedra than these"},
};
inline constexpr KeyInfo rotate[] = {
    {"axis", form::direction, "", required, "normalised when read; right-handed"},
    {"origin", form::vector, "m", "", "a point of the axis"},
    {"degrees", form::between(-1e9, 1e9), "°", required, "angle"},
};
inline constexpr KeyInfo materials[] = {
    {"law", form::other("name of a [law](../../engine/docs/laws.md)"), "", "required, or `preset`",
     "with the law's parameters as further keys"},
    {"region", region, "", none, "elements with this tag in the mesh; without: all that no entry names"},
    {"density", form::positive, "kg/m³", "", "mass, lumped in equal parts on the nodes of each tetrahedron"},
    {"preset", form::other("name of a [preset](../../engine/docs/laws.md#presets)"), "", none,
     "law and parameters of a tissue, with their source"},
    {"young", quantity, "Pa", one_parameters, "Young's modulus, > 0"},
    {"poisson", quantity, "", "with `young`", "Poisson's ratio, > −1 and < 0.5"},
    {"expression", form::text, "", "required by `energy`",
     "energy per unit rest volume, Pa, of [invariants and stretches](../../engine/docs/laws.md#energy)"},
    {"parameters", object, "", "`{}`", "a number for each other name in the expression"},
    {"fibre", form::other("`[x, y, z]`, or `{\"field\": NAME}`"), "",
     "required by laws with fibres, and by `active_stress`",
     "direction at rest, normalised when read; a field for `p2` may have 12 numbers an element, a direction at each of "
     "its [points](../../engine/docs/elements.md#fibres)"},
    {"active_stress", form::non_negative, "Pa", "0",
     "of contracting muscle, Ta: second Piola-Kirchhoff stress Ta a0⊗a0 along `fibre`; static scenes ramp it with "
     "their loads; changed by the event `active_stress`"},
    {"volume_term", form::one_of(volume_term_names), "", "`\"quadratic\"`",
     "κ/2 (J−1)², κ/2 (ln J)² or κ/4 (J² − 1 − 2 ln J); laws with a volume term"},
    {"viscosity", form::non_negative, "Pa s", "0", "shear viscosity η: σ = 2 η ε̇ + ζ tr(ε̇) I at small strain"},
    {"bulk_viscosity", form::non_negative, "Pa s", "0", "bulk viscosity ζ"},
    {"relaxation", objects, "", "`[]`", "Prony series: G(t)/G∞ = 1 + Σ γ exp(−t/τ), of the isochoric part"},
    {"plasticity", object, "", none, "von Mises plasticity with linear hardening, of the isochoric part"},
};
inline constexpr KeyInfo relaxation[] = {
    {"gamma", form::positive, "", required, "γ: strength relative to the long-term modulus"},
    {"tau", form::positive, "s", required, "τ: relaxation time"},
};
inline constexpr KeyInfo plasticity[] = {
    {"yield", form::positive, "Pa", required, "von Mises stress (Kirchhoff) at which flow begins"},
    {"hardening", form::non_negative, "Pa", "", "per unit of equivalent plastic strain"},
};
inline constexpr KeyInfo field[] = {
    {"field", form::text, "", required, "name of a field of the mesh file with a value an element"},
};
inline constexpr KeyInfo boundary[] = {
    nodes_row,
    box_row,
    sphere_row,
    {"fix", form::flag, "", one_motion, "the nodes stay where they are at rest"},
    {"translate", form::vector, "m", one_motion, "of the rest position, after `rotate`"},
    {"rotate", object, "", one_motion, "of the rest position"},
    {"axes", form::text, "", "`\"xyz\"`",
     "the coordinates that are fixed or translated, the others stay free: `\"y\"` is a roller on a plane y = const"},
    {"over", form::non_negative, "s", "", "translation and angle grow linearly over this time; 0: at once"},
};
inline constexpr KeyInfo loads[] = {
    nodes_row,
    box_row,
    sphere_row,
    {"force", form::vector, "N", one_load, "in all, shared equally by the nodes"},
    {"traction", form::vector, "Pa", one_load, "of rest area, on boundary faces whose three nodes are selected"},
    {"pressure", form::number, "Pa", one_load, "on the same faces, against the outward normal of the deformed surface"},
    {"over", form::non_negative, "s", "", "grows linearly over this time; 0: at once"},
};
inline constexpr KeyInfo elements[] = {
    {"tets", form::other("list of whole numbers ≥ 0"), "", one_elements,
     "these tetrahedra, in the order of the mesh file"},
    {"region", region, "", one_elements, "those with this tag in the mesh"},
    {"box", box_row.form, "m", one_elements, "those whose centroid is in this box at rest"},
    {"sphere", sphere_row.form, "m", one_elements, "those whose centroid is in this sphere at rest"},
};
inline constexpr std::string_view one_region = "one of `nodes`, `tets`, `region`, `box`, `sphere`";
inline constexpr KeyInfo region_nodes_row{"nodes", nodes_row.form, "", one_region,
                                          "elements whose four corners are all among these"};
inline constexpr KeyInfo region_tets_row{"tets", elements[0].form, "", one_region, elements[0].meaning};
inline constexpr KeyInfo region_region_row{"region", region, "", one_region, elements[1].meaning};
inline constexpr KeyInfo region_box_row{"box", box_row.form, "m", one_region, elements[2].meaning};
inline constexpr KeyInfo region_sphere_row{"sphere", sphere_row.form, "m", one_region, elements[3].meaning};
inline constexpr KeyInfo region_name_row{"name", form::text, "", required,
                                         "of the region: that there is of this name, or a new one"};
inline constexpr KeyInfo region_number_row{"number", region, "", "that of the name, or one more than the largest",
                                           "its tag, by which `materials` name it"};
inline constexpr KeyInfo regions[] = {region_nodes_row, region_tets_row,  region_region_row, region_box_row,
                                      region_sphere_row, region_name_row, region_number_row};
inline constexpr KeyInfo region_event[] = {
    region_nodes_row,  region_tets_row, region_region_row, region_box_row,
    region_sphere_row, region_name_row, region_number_row,
    {"material", object, "", "as it is, or as its first element's",
     "entry as of the scene's `materials`, without `region` and fields"}};
inline constexpr KeyInfo active_stress_event[] = {
    {"stress", form::non_negative, "Pa", required, "Ta, from now on"},
    {"region", region, "", "the default entry", "entry of `materials` to change"},
};
inline constexpr KeyInfo tables[] = {
    {"point", form::vector, "m", required, "a point of the plane"},
    {"normal", form::direction, "", required, "towards the tissue; normalised when read"},
    friction_row,
};
inline constexpr KeyInfo self_contact[] = {
    friction_row,
    {"within_bodies", form::flag, "", "true",
     "`false`: bodies that share no node bear on each other alone, and no fold or cut of one on itself; takes less "
     "time"},
};
inline constexpr KeyInfo tearing[] = {
    {"stretch", form::other("number > 1"), "", required, "greatest principal stretch that elements bear"},
};
inline constexpr KeyInfo solver[] = {
    {"integrator", form::one_of(integrator_names), "", "", "`auto` chooses by a fixed model of cost"},
    {"step", form::positive, "s", "by the stable step",
     "one step a tick, obeyed exactly; an explicit one that is unstable ends the run (exit code 4)"},
    {"rate", form::between(1, 1e6), "Hz", "1000; implicit methods 100, `static` 30",
     "ticks a second, where no step is given; explicit methods take as many stable steps a tick as it needs"},
    {"duration", form::non_negative, "s", "", "of `heml solve`"},
    {"damping", form::non_negative, "1/s", "", "proportional to mass"},
    {"mass_scaling", form::between(0, 1), "", "`0`",
     "share of the mass that may be added at nodes that limit the steps of explicit methods; gravity acts on the true "
     "masses"},
    {"precision", form::one_of<precision_names>(), "", "",
     "of the arithmetic; `\"float\"` computes in double what lies farther from the origin than 32 of its diagonals"},
    {"threads", form::whole(0, max_threads), "", "", "0: all cores; never changes a bit of the result"},
    {"element", form::one_of<element_names>(), "", "",
     "linear tetrahedra with a pressure each, or with averaged nodal pressure (near ν = 0.5); `p2`: quadratic "
     "tetrahedra; `p2_pressure`: with mean dilatation, near ν = 0.5 (`engine/docs/elements.md`)"},
    {"continuation", form::flag, "", "",
     "laws go on past the end of their range; else the run ends there (exit code 4)"},
    {"recovery", form::flag, "", "", "a collapsed body is brought back instead of ending the run; not with `static`"},
    {"tolerance", form::positive, "", "1e-8; in `float` 1e-4",
     "of implicit and static solves: residual relative to the larger of external forces and reactions"},
    {"budget", object, "", none, "how much an implicit stage may take; a step never gains energy for it"},
    {"minimiser", form::one_of<minimiser_names>(), "", "`\"newton\"`", "of implicit steps; statics are Newton's"},
    {"projection", form::one_of<projection_names>(), "", "`\"element\"`",
     "of a stiffness that is seen not to be positive"},
    {"preconditioner", form::one_of<preconditioner_names>(), "", "by the body's size", "of linear solves"},
};
inline constexpr KeyInfo budget[] = {
    {"iterations", form::whole(1, 1000), "", "one of the two", "of the minimiser, a stage"},
    {"milliseconds", form::positive, "ms", "one of the two", "a tick; recordings hold the iterations it came to"},
    {"linear", form::whole(1, 1000), "", none,
     "iterations of each linear solve, so that badly shaped elements do not decide what a step costs"},
};
inline constexpr KeyInfo outputs[] = {
    {"times", form::other("list of numbers ≥ 0"), "s", "",
     "`positions_<k>.csv` at each, at most `solver.duration`; of `static` fractions of the load"},
    {"positions", form::flag, "", "", "`positions.csv` at the end"},
    {"vtu", form::flag, "", "", "`.vtu` files beside the `.csv` ones, with fields"},
    {"markers", objects, "", "`[]`", "mean places and velocities of nodes over time: `markers.csv`"},
    {"history", form::flag, "", "`false`",
     "energies, volume ratios, tool force and reactions over time: `history.csv`"},
    {"every", form::positive, "s", "every tick", "time between rows of `markers.csv` and `history.csv`"},
};
inline constexpr KeyInfo markers[] = {
    {"name", form::text, "", "its number", "without commas, quotes and line ends"},
    nodes_row,
    box_row,
    sphere_row,
};
inline constexpr KeyInfo initial[] = {
    {"velocity", form::vector, "m/s", "", "of all nodes that no boundary entry holds"},
    {"positions", form::text, "", "the rest shape", "CSV file `node,x,y,z` with every node"},
};
inline constexpr KeyInfo view[] = {
    {"azimuth", form::between(-360, 360), "°", "the window's own", "of the camera, about the vertical"},
    {"elevation", form::between(-90, 90), "°", "the window's own", "of the camera, above the horizon"},
    {"side", form::one_of<standard_view_names>(), "", "none",
     "that faces the camera, in place of `azimuth` and `elevation`"},
    {"zoom", form::between(0.01, 100), "", "1", "1: the body fills the picture"},
    {"orthographic", form::flag, "", "`false`", "without perspective"},
    {"field", form::one_of<field_names>(), "", "", "colours of the surface"},
    {"wireframe", form::flag, "", "", "edges of the mesh"},
    {"section", form::direction, "", "no section",
     "normal of a plane that cuts the drawn body open, towards what is left out; normalised when read"},
    {"section_at", form::number, "m", "0", "of that plane along its normal, from the centre of the body at rest"},
    {"range", form::other("[low, high]"), "the field's", "of the values shown", "of the colours"},
    {"hidden", form::other("list of whole numbers"), "", "none", "regions that are not drawn"},
};
inline constexpr KeyInfo recorded[] = {
    {"nodes", count, "", required, "of the mesh"},
    {"tets", count, "", required, "of the mesh"},
    {"mesh", hash, "", required, "of positions as placed, elements, regions and the fields that materials use"},
    {"instructions", form::other("`\"portable\"`, `\"avx2\"` or `\"avx512\"`"), "", "not told",
     "of the force kernels; states of others differ by round-off"},
    {"format", form::whole(1, 2), "", "1",
     "2: there is an end entry with the last state and the number of checkpoints"},
    {"kernel_revision", count, "", "0", "raised whenever states come to other bits"},
    {"build", form::text, "", "not told", "of the program that recorded"},
};

inline constexpr KeyInfo skin[] = {
    {"file", form::text, "", required,
     "surface in the place and unit of the mesh, of any resolution: `.obj`, `.ply` ..."},
    {"texture", form::text, "", "the one that the surface names", "image, `.png`, over its texture coordinates"},
};

}  // namespace scene_keys

/// In the order of the reference page.
inline constexpr ObjectInfo scene_objects[] = {
    {"", "The whole scene.", scene_keys::scene, R"({})"},
    {"mesh", "The body at rest, and where it is put.", scene_keys::mesh, R"({})"},
    {"mesh.box", "A regular mesh.", scene_keys::mesh_box, R"({})"},
    {"mesh.tetgen", "What TetGen is asked for.", scene_keys::tetgen,
     R"({"mesh": {"box": null, "surface": "a.stl", "tetgen": {}}})"},
    {"mesh.refine", "Refinement before the first step. `heml refine` does the same once and writes the mesh.",
     scene_keys::refine, R"({"mesh": {"refine": {}}})"},
    {"mesh.rotate", "A rotation, here and in `boundary`.", scene_keys::rotate,
     R"({"mesh": {"rotate": {"axis": [0, 0, 1], "degrees": 90}}})"},
    {"materials[]", "An entry without `region` is the default; one with `region` wins over it.", scene_keys::materials,
     R"({})"},
    {"materials[].relaxation[]", "A branch of the Prony series.", scene_keys::relaxation,
     R"({"materials": [{"law": "neo_hookean_iso", "K1": 1, "kappa": 9, "relaxation": [{"gamma": 1, "tau": 1}]}]})"},
    {"materials[].plasticity", "Laws with a volume term and without fibres.", scene_keys::plasticity,
     R"({"materials": [{"law": "neo_hookean_iso", "K1": 1, "kappa": 9, "plasticity": {"yield": 1}}]})"},
    {"materials[].young", "Numbers that differ from element to element; likewise `poisson`, `fibre` and parameters.",
     scene_keys::field, R"({"materials": [{"law": "stvk", "young": {"field": "E"}, "poisson": 0}]})"},
    {"regions[]", "Elements that are a region by choice. Later entries win.", scene_keys::regions,
     R"({"regions": [{"tets": [0], "name": "lesion"}]})"},
    {"boundary[]", "Nodes that are held, or moved to rotate(X − origin) + origin + translate.", scene_keys::boundary,
     R"({"boundary": [{"nodes": [0], "fix": true}]})"},
    {"loads[]", "Loads on nodes and faces. Faces that a cut lays bare carry none.", scene_keys::loads,
     R"({"loads": [{"nodes": [0], "force": [0, 0, 1]}]})"},
    {"tables[]", "Planes with friction. `report.json` has force and work of each.", scene_keys::tables,
     R"({"tables": [{"point": [0, 0, 0], "normal": [0, 1, 0]}]})"},
    {"self_contact", "`true` is `{}`.", scene_keys::self_contact, R"({"self_contact": {}})"},
    {"tearing", "Dynamics alone.", scene_keys::tearing, R"({"tearing": {"stretch": 2}})"},
    {"solver", "How the motion is computed.", scene_keys::solver, R"({"solver": {}})"},
    {"solver.budget", "For runs that must be on time.", scene_keys::budget,
     R"({"solver": {"budget": {"iterations": 1}}})"},
    {"outputs", "Files of `heml solve`.", scene_keys::outputs, R"({"outputs": {}})"},
    {"outputs.markers[]", "A place that is followed.", scene_keys::markers,
     R"({"outputs": {"markers": [{"nodes": [0]}]}})"},
    {"initial", "State at time 0. Without it the body starts at rest in its rest shape.", scene_keys::initial,
     R"({"initial": {}})"},
    {"view", "How a viewer begins.", scene_keys::view, R"({"view": {}})"},
    {"skin", "Drawn while no region is hidden; cut, torn and removed with the body.", scene_keys::skin,
     R"({"skin": {"file": "a.obj"}})"},
    {"recorded", "Written by the program.", scene_keys::recorded,
     R"({"recorded": {"nodes": 8, "tets": 5, "mesh": "0123456789abcdef"}})"},
};

/// The keys of an object by its path. A path that is not in the list does not compile.
consteval std::span<const KeyInfo> keys_of(std::string_view path) {
  for (const ObjectInfo& object : scene_objects)
    if (object.path == path) return object.keys;
  throw "no object of a scene has this path";
}

static_assert([] {
  for (const ObjectInfo& object : scene_objects)
    if (!is_complete(object.keys)) return false;
  return true;
}());

}  // namespace heml
