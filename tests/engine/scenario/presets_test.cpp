#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/text_file.hpp>
#include <places.hpp>

#include "samples.hpp"

namespace heml::presets_test {

namespace {

double published(const Preset& preset, const std::string& name) {
  for (const auto& [key, value] : preset.published)
    if (key == name) return value;
  FAIL("nothing published as ", name);
  return 0;
}

/// Deletes a file in its destructor.
struct Removed {
  std::filesystem::path path;
  ~Removed() { std::filesystem::remove(path); }
};

/// Reads a preset's file after a JSON merge patch.
Preset read_changed(const std::string& patch) {
  const auto source = test::source_folder() / "assets" / "materials" / "brain_ogden.json";
  Json json = parse_json(read_text_file(source), source.string());
  json.merge_patch(Json::parse(patch));
  const auto path = std::filesystem::temp_directory_path() / fmt::format("heml-preset-test-{}.json", getpid());
  write_file(path, json.dump());
  const Removed removed{path};
  return read_preset(path);
}

std::string refusal(const std::string& patch) {
  try {
    read_changed(patch);
  } catch (const InputError& error) {
    return error.what();
  }
  FAIL("was read: ", patch);
  return {};
}

}  // namespace

TEST_CASE("every preset is a sound material with a source, in the order of tissues") {
  REQUIRE(presets().size() >= 8);
  for (const Preset& preset : presets()) {
    CAPTURE(preset.name);
    CHECK_FALSE(material_problem(preset.material));
    CHECK_FALSE(preset.title.empty());
    CHECK_FALSE(preset.tissue.empty());
    CHECK_FALSE(preset.convention.empty());
    CHECK_FALSE(preset.source.authors.empty());
    CHECK_FALSE(preset.published.empty());
    CHECK_FALSE(preset.verified);  // not compared with the sources yet; whoever does so changes file and test
    CHECK(find_preset(preset.name) == &preset);
    CHECK(preset_of(preset.material) == &preset);
  }
  CHECK(std::is_sorted(presets().begin(), presets().end(),
                       [](const Preset& a, const Preset& b) { return a.tissue < b.tissue; }));
  CHECK(find_preset("steel") == nullptr);
}

TEST_CASE("published numbers become the material's as the convention says") {
  for (const char* name : {"brain_ogden", "brain_ogden_swine"}) {  // coefficient 2μ/α² in the source, μ/α here
    CAPTURE(name);
    const Preset* brain = find_preset(name);
    REQUIRE(brain);
    const double mu = published(*brain, "mu"), alpha = published(*brain, "alpha");
    CHECK(brain->material.parameters[0] == doctest::Approx(2 * mu / alpha).epsilon(1e-14));
    CHECK(brain->material.parameters[1] == alpha);
    CHECK(small_strain_moduli(brain->material).shear == doctest::Approx(mu).epsilon(1e-12));
  }
  CHECK(find_preset("brain_ogden")->material.parameters[2] == published(*find_preset("brain_ogden"), "kappa"));
  for (const char* name : {"liver_human", "spleen_pig", "uterus_soft", "uterus_stiff"}) {
    CAPTURE(name);
    const auto& lame = find_preset(name)->material.parameters;
    const EngineeringConstants now = engineering_constants({lame[0], lame[1]});
    CHECK(now.young == doctest::Approx(published(*find_preset(name), "young")).epsilon(1e-12));
    CHECK(now.poisson == doctest::Approx(0.49).epsilon(1e-12));
  }
  CHECK(find_preset("skin_suction")->material.parameters[0] == published(*find_preset("skin_suction"), "C10"));
  const Preset& heart = *find_preset("myocardium_hgo");
  CHECK(heart.material.parameters[0] == published(heart, "a") / 2);
  CHECK(heart.material.parameters[2] == published(heart, "a_f"));
  CHECK(heart.material.parameters[3] == published(heart, "b_f"));
  const Preset& muscle = *find_preset("myocardium_guccione");
  const std::vector<double> numbers = {published(muscle, "C"), published(muscle, "b_f"), published(muscle, "b_t"),
                                       published(muscle, "b_fs"), 1e5};
  CHECK(muscle.material.parameters == numbers);
}

TEST_CASE("bulk moduli of this project's choice are those of Poisson's ratio 0.49") {
  for (const char* name : {"brain_ogden_swine", "skin_suction", "liver_human"}) {
    CAPTURE(name);
    const auto [mu, kappa] = small_strain_moduli(find_preset(name)->material);
    CHECK((3 * kappa - 2 * mu) / (2 * (3 * kappa + mu)) == doctest::Approx(0.49).epsilon(1e-9));
  }
}

TEST_CASE("a changed number makes a material of its own") {
  Material material = find_preset("brain_ogden")->material;
  material.density = 1040;
  CHECK(preset_of(material) == find_preset("brain_ogden"));
  material.parameters[0] *= 1.001;
  CHECK(preset_of(material) == nullptr);
  Material heart = find_preset("myocardium_hgo")->material;
  heart.fibre = Vec3::UnitZ();
  CHECK(preset_of(heart) == find_preset("myocardium_hgo"));
}

TEST_CASE("an entry with a preset has its numbers, and what stands beside the name") {
  const auto read = [](const char* text) {
    const Json json = Json::parse(text);
    return preset_entry(JsonCursor(json, "scene.json", "materials[1]"));
  };
  const RegionMaterial heart =
      read(R"({"preset": "myocardium_hgo", "region": 3, "density": 1060, "fibre": [0, 0, 2]})");
  CHECK(heart.region == 3);
  CHECK(heart.material.density == 1060);
  CHECK(heart.material.fibre == Vec3::UnitZ());
  CHECK(preset_of(heart.material) == find_preset("myocardium_hgo"));
  const RegionMaterial liver = read(R"({"preset": "liver_human"})");
  CHECK_FALSE(liver.region);
  CHECK(preset_of(liver.material) == find_preset("liver_human"));
  const auto refused = [&](const char* text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(says(refused(R"({"preset": "brain_ogdan"})"), "did you mean 'brain_ogden'"));
  CHECK(says(refused(R"({"preset": "brain_ogden", "kappa": 5})"), "kappa: comes with the preset"));
  CHECK(says(refused(R"({"preset": "brain_ogden", "law": "stvk"})"), "law: comes with the preset"));
  CHECK(says(refused(R"({"preset": "brain_ogden", "density": -1})"), "density"));
  CHECK(says(refused(R"({"preset": "brain_ogden", "densty": 1})"), "densty"));
}

TEST_CASE("a citation says what is known and nothing else") {
  const Citation& miller = find_preset("brain_ogden_swine")->source;
  CHECK(
      to_text(miller) ==
      "K. Miller, K. Chinzei (2002): Mechanical properties of brain tissue in tension. Journal of Biomechanics 35 (4), "
      "483-490. doi:10.1016/S0021-9290(01)00234-2");
  CHECK(short_text(miller) == "Miller & Chinzei 2002");
  CHECK(short_text(find_preset("liver_human")->source) == "Carter et al. 2001");
  CHECK(to_text(find_preset("skin_suction")->source) == "F. M. Hendriks et al.");
  CHECK(short_text(find_preset("skin_suction")->source) == "Hendriks et al.");
}

TEST_CASE("a range of stretches is read, or not known") {
  const Preset& swine = *find_preset("brain_ogden_swine");
  REQUIRE(swine.stretch_range);
  CHECK(swine.stretch_range->low == doctest::Approx(std::exp(-0.3)).epsilon(1e-15));
  CHECK(swine.stretch_range->high == doctest::Approx(std::exp(0.2)).epsilon(1e-15));
  CHECK_FALSE(find_preset("brain_ogden")->stretch_range);
}

TEST_CASE("refuses a preset that is wrong, naming the key") {
  CHECK(read_changed("{}").shear_modulus == 670);
  CHECK(says(refusal(R"({"shear_modulus": 335})"), "shear_modulus: is 335"));
  CHECK(says(refusal(R"({"shear_modulus": 335})"), "670"));
  CHECK(says(refusal(R"({"material": {"law": "steel"}})"), "material.law"));
  CHECK(says(refusal(R"({"material": {"preset": "brain_ogden"}})"), "a preset in a preset"));
  CHECK(says(refusal(R"({"stretch_range": [1.2, 0.8]})"), "stretch_range"));
  CHECK(says(refusal(R"({"stretch_range": 1.2})"), "stretch_range"));
  CHECK(says(refusal(R"({"verifyed": true})"), "did you mean 'verified'"));
  CHECK(says(refusal(R"({"source": {"year": "2002"}})"), "source.year"));
  CHECK(says(refusal(R"({"published": {"mu": "a"}})"), "published.mu"));
}

}  // namespace heml::presets_test
