#pragma once
// Rows of the table of commands: what changes the body, its material and how its motion is computed.
#include <algorithm>
#include <heml/scenario/command_row.hpp>
#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>

namespace heml::command_rows {

template <>
struct Row<SetMaterial> : CommonRow {
  static constexpr std::string_view key = "material",
                                    example = R"({"region": 2, "law": "neo_hookean", "young": 2e4, "poisson": 0.4})",
                                    meaning =
                                        "replaces the material of a region, or the default; the body goes on, other "
                                        "materials with their internal state";
  static constexpr ValueForm value_form = form::other(
      "entry as of the scene's `materials`; no field of the mesh but the fibre's, where the material has it already");
  static Command read(const JsonCursor& value, Points&) {
    const RegionMaterial entry = material_from(value);
    if (!entry.material.fields.empty())
      value.fail("takes a field of the mesh", "a material switched to takes numbers, but for its fibre");
    return SetMaterial{entry.region, entry.material};
  }
  static Json write(const SetMaterial& set) { return material_json({set.region, set.material}); }
};

template <>
struct Row<SetActiveStress> : CommonRow {
  static constexpr std::string_view key = "active_stress", example = R"({"region": 2, "stress": 6e4})",
                                    meaning =
                                        "contracts or relaxes the muscle of a region, or of the default material, "
                                        "which has a `fibre`; internal state is kept";
  static constexpr ValueForm value_form = object_form;
  static constexpr std::span<const KeyInfo> keys = scene_keys::active_stress_event;
  static Command read(const JsonCursor& value, Points&) {
    const ObjectReader entry(value, keys);
    SetActiveStress set;
    entry.read("region", set.region);
    set.stress = entry.get<double>("stress");
    return set;
  }
  static Json write(const SetActiveStress& set) {
    Json json{{"stress", set.stress}};
    if (set.region) json["region"] = *set.region;
    return json;
  }
};

template <>
struct Row<TagRegion> : CommonRow {
  static constexpr std::string_view key = "region",
                                    example = R"({"tets": [3, 4], "name": "lesion"})",
                                    meaning =
                                        "makes elements a region with a material of its own; elements that get "
                                        "another material begin relaxed in their present shape, and so do all of a "
                                        "material that others join";
  static constexpr ValueForm value_form = object_form;
  static constexpr std::span<const KeyInfo> keys = scene_keys::region_event;
  static Command read(const JsonCursor& value, Points&) {
    TagRegion tag{region_tag_from(value, keys), {}};
    const auto material = value.find("material");
    if (!material) return tag;
    const RegionMaterial entry = material_from(*material);
    if (entry.region) material->fail("names a region", "the event's own is meant: leave it out");
    if (uses_fields(entry.material)) material->fail("takes a field of the mesh", "give numbers");
    tag.material = entry.material;
    return tag;
  }
  static Json write(const TagRegion& tag) {
    Json json = region_tag_json(tag.tag);
    if (tag.material) json["material"] = material_json({std::nullopt, *tag.material});
    return json;
  }
};

template <>
struct Row<SetDamping> : CommonRow {
  static constexpr std::string_view key = "damping", example = "2", unit = "1/s",
                                    meaning = "sets the damping proportional to mass";
  static constexpr ValueForm value_form = form::non_negative;
  static Command read(const JsonCursor& value, Points&) { return SetDamping{value_of<double>(value, value_form)}; }
  static Json write(const SetDamping& set) { return set.damping; }
};

template <>
struct Row<SetGravity> : CommonRow {
  static constexpr std::string_view key = "gravity", example = "[0, -9.81, 0]", unit = "m/s²", meaning = "sets gravity";
  static constexpr ValueForm value_form = form::vector;
  static Command read(const JsonCursor& value, Points&) { return SetGravity{value_of<Vec3>(value, value_form)}; }
  static Json write(const SetGravity& set) { return vector_json(set.gravity); }
};

template <>
struct Row<SetIntegrator> : CommonRow {
  static constexpr std::string_view key = "integrator", example = "\"tr_bdf2\"",
                                    meaning = "changes the method; `static` cannot be entered or left";
  static constexpr ValueForm value_form = form::one_of(integrator_names);
  static Command read(const JsonCursor& value, Points&) {
    return SetIntegrator{value_of<Integrator>(value, value_form)};
  }
  static Json write(const SetIntegrator& set) { return integrator_name(set.integrator); }
};

template <>
struct Row<SetBudget> : CommonRow {
  static constexpr std::string_view key = "budget", example = "2",
                                    meaning =
                                        "sets the iterations of an implicit stage; sent by sessions whose budget "
                                        "is in milliseconds";
  static constexpr ValueForm value_form = form::whole(1, 1000);
  static Command read(const JsonCursor& value, Points&) { return SetBudget{value_of<int>(value, value_form)}; }
  static Json write(const SetBudget& set) { return set.iterations; }
};

template <>
struct Row<SetRate> : CommonRow {
  static constexpr std::string_view key = "rate", example = "60", unit = "Hz",
                                    meaning =
                                        "sets the ticks of a simulated second; `at` of later events counts by the "
                                        "scene's own rate all the same";
  static constexpr ValueForm value_form = form::between(1, 1e6);
  static Command read(const JsonCursor& value, Points&) { return SetRate{value_of<double>(value, value_form)}; }
  static Json write(const SetRate& set) { return set.rate; }
};

template <>
struct Row<SetStepCost> : CommonRow {
  static constexpr std::string_view key = "step_cost", example = "40", unit = "ns",
                                    meaning =
                                        "sets what an explicit step costs an element, for `auto`; sent by "
                                        "sessions, which measure it";
  static constexpr ValueForm value_form = form::positive;
  static Command read(const JsonCursor& value, Points&) { return SetStepCost{value_of<double>(value, value_form)}; }
  static Json write(const SetStepCost& set) { return set.nanoseconds; }
};

template <>
struct Row<RemoveElements> : CommonRow {
  static constexpr std::string_view key = "remove", example = R"({"sphere": [[0.05, 0.01, 0.01], 0.008]})",
                                    meaning = "takes elements out of the body, with their mass and energy";
  static constexpr ValueForm value_form = object_form;
  static constexpr std::span<const KeyInfo> keys = scene_keys::elements;
  static constexpr std::optional<CommandTool> tool = CommandTool::removal;
  static constexpr bool takes_up = true;
  static Command read(const JsonCursor& value, Points&) { return RemoveElements{elements_from(value)}; }
  static Json write(const RemoveElements& remove) { return elements_json(remove.which); }
  static References references(RemoveElements& remove) {
    References result;
    for (std::size_t k = 0; k < remove.which.tets.size(); ++k)
      result.push_back({MeshReference::Kind::element, &remove.which.tets[k], fmt::format("remove.tets[{}]", k)});
    return result;
  }
};

/// The two ends of a blade or an electrode at successive times.
inline Sweep sweep_from(const JsonCursor& list, const char* what) {
  Sweep sweep;
  list.each([&](const JsonCursor& blade) {
    if (blade.size() != 2) blade.refuse(fmt::format("must be the two ends of the {}, [[x, y, z], [x, y, z]]", what));
    sweep.blades.push_back({blade[0].vector(), blade[1].vector()});
  });
  return sweep;
}
inline Json sweep_json(const Sweep& sweep) {
  Json json = Json::array();
  for (const auto& [tip, end] : sweep.blades) json.push_back({vector_json(tip), vector_json(end)});
  return json;
}

template <>
struct Row<CutTissue> : CommonRow {
  static constexpr std::string_view
      key = "cut",
      example = R"({"sweep": [[[0.05, 1, 1], [0.05, 1, -1]], [[0.05, -1, 1], [0.05, -1, -1]]]})",
      meaning = "parts the tissue along what a blade sweeps";
  static constexpr ValueForm value_form = object_form;
  static constexpr KeyInfo cut_keys[] = {
      {"sweep", form::other("list of `[[x, y, z], [x, y, z]]`, two or more"), "m", required,
       "the two ends of the blade at successive times"},
      {"goes_on", form::flag, "", "`false`", "one stroke, and one edit to undo, with the cut before"}};
  static constexpr std::span<const KeyInfo> keys = cut_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::cut;
  static bool takes_up(const CutTissue& cut) { return !cut.continues_stroke; }
  static Command read(const JsonCursor& value, Points&) {
    const ObjectReader object(value, keys);
    CutTissue cut{sweep_from(object["sweep"], "blade")};
    if (cut.sweep.blades.size() < 2) object["sweep"].refuse("must have the blade at two times at least");
    object.read("goes_on", cut.continues_stroke);
    return cut;
  }
  static Json write(const CutTissue& cut) {
    Json json = {{"sweep", sweep_json(cut.sweep)}};
    if (cut.continues_stroke) json["goes_on"] = true;
    return json;
  }
};

template <>
struct Row<CauterizeTissue> : CommonRow {
  static constexpr std::string_view
      key = "cauterize",
      example = R"({"line": [[0.02, 0.02, 0.01], [0.06, 0.02, 0.01]], "radius": 0.006})",
      meaning =
          "an electrode coagulates the tissue about its path, which shrinks at rest, and with a `sweep` parts it too";
  static constexpr ValueForm value_form = object_form;
  static constexpr std::string_view path = "one of `line`, `sweep`";
  static constexpr KeyInfo cauterize_keys[] = {
      {"line", form::other("list of `[x, y, z]`, one or more"), "m", path,
       "where the tip of the electrode is at successive times: it burns and parts nothing"},
      {"sweep", form::other("list of `[[x, y, z], [x, y, z]]`, one or more"), "m", path,
       "the two ends of a long electrode, which cuts as a blade does"},
      {"radius", form::positive, "m", required,
       "about the path, as the tissue lies then: coagulated up to half of it, and less and less up to all of it"},
      {"shrink", form::between(0, max_shrink), "", "", "part of their length that coagulated lengths lose"},
      {"goes_on", form::flag, "", "`false`", "one stroke, and one edit to undo, with the one before"}};
  static constexpr std::span<const KeyInfo> keys = cauterize_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::cautery;
  static bool takes_up(const CauterizeTissue& burn) { return !burn.continues_stroke; }
  static Command read(const JsonCursor& value, Points&) {
    const ObjectReader object(value, keys);
    CauterizeTissue burn;
    const std::string given = value.only_one_of({"line", "sweep"});
    if (given == "sweep")
      burn.sweep = sweep_from(object["sweep"], "electrode");
    else
      object["line"].each([&](const JsonCursor& place) {
        const Vec3 tip = place.vector();
        burn.sweep.blades.push_back({tip, tip});
      });
    if (burn.sweep.blades.empty()) object[given].fail("is empty", "give one place of the electrode or more");
    burn.heat.radius = object.get<double>("radius");
    object.read("shrink", burn.heat.shrink);
    object.read("goes_on", burn.continues_stroke);
    return burn;
  }
  static Json write(const CauterizeTissue& burn) {
    Json json;
    const auto& blades = burn.sweep.blades;
    if (std::all_of(blades.begin(), blades.end(), [](const auto& blade) { return blade[0] == blade[1]; })) {
      json["line"] = Json::array();
      for (const auto& blade : blades) json["line"].push_back(vector_json(blade[0]));
    } else {
      json["sweep"] = sweep_json(burn.sweep);
    }
    json["radius"] = burn.heat.radius;
    json["shrink"] = burn.heat.shrink;
    if (burn.continues_stroke) json["goes_on"] = true;
    return json;
  }
};

/// Commands without a setting: their value is `true`.
template <class C>
struct PlainRow : CommonRow {
  static constexpr std::string_view example = "true";
  static constexpr ValueForm value_form = true_form;
  static Command read(const JsonCursor& value, Points&) {
    expect_true(value);
    return C{};
  }
  static Json write(const C&) { return true; }
};

template <>
struct Row<AdoptPreconditioner> : PlainRow<AdoptPreconditioner> {
  static constexpr std::string_view key = "factor",
                                    meaning =
                                        "preconditions by the body as it is now; sent by sessions, when that has "
                                        "arrived from another thread";
};

template <>
struct Row<Undo> : PlainRow<Undo> {
  static constexpr std::string_view key = "undo", meaning = "takes back the last removal or stroke";
  static constexpr std::optional<CommandTool> tool = CommandTool::undo;
  static constexpr bool takes_up = true;
};

template <>
struct Row<StepHistory> : CommonRow {
  static constexpr std::string_view key = "history", example = "-1",
                                    meaning =
                                        "takes back (-1) the last action of any kind, or brings back (1) the last one "
                                        "taken back: the whole state of that moment; ticks go on counting";
  static constexpr ValueForm value_form = form::other("-1 or 1");
  static constexpr std::optional<CommandTool> tool = CommandTool::undo;
  static constexpr bool takes_up = true;
  static Command read(const JsonCursor& value, Points&) {
    const int by = value_of<int>(value, form::whole(-1, 1));
    if (by == 0) value.refuse("must be -1 (undo) or 1 (redo)");
    return StepHistory{by};
  }
  static Json write(const StepHistory& step) { return step.by; }
};

template <>
struct Row<Reset> : CommonRow {
  static constexpr std::string_view key = "reset", example = "true",
                                    meaning =
                                        "puts the body back to its initial state; `\"scene\"`: materials, regions, "
                                        "boundary, loads, gravity, tables and method too; ticks go on counting";
  static constexpr ValueForm value_form = form::other("`true`, or `\"scene\"`");
  static Command read(const JsonCursor& value, Points&) {
    if (!value.json().is_string()) return expect_true(value), Reset{};
    if (value.text() != "scene") value.refuse("must be true (the state), or \"scene\" (all of the scene)");
    return Reset{true};
  }
  static Json write(const Reset& reset) { return reset.scene ? Json("scene") : Json(true); }
};

}  // namespace heml::command_rows
