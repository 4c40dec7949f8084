// Entries of `materials`: reading, writing, refusal.
#include <doctest/doctest.h>

#include <engine/materials/sample_materials.hpp>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/young_poisson.hpp>

namespace heml::material_json_test {
namespace {

using Values = std::vector<double>;

RegionMaterial read(const std::string& text) {
  const Json json = Json::parse(text);
  return material_from(JsonCursor(json, "m.json"));
}

void expect_same(const Material& a, const Material& b) {
  CHECK(a.law == b.law);
  CHECK(a.parameters == b.parameters);
  CHECK(a.density == b.density);
  CHECK(a.fibre == b.fibre);
  CHECK(a.fibre_field == b.fibre_field);
  REQUIRE(a.fields.size() == b.fields.size());
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    CHECK(a.fields[i].parameter == b.fields[i].parameter);
    CHECK(a.fields[i].field == b.fields[i].field);
  }
  CHECK(a.active_stress == b.active_stress);
  CHECK(a.volume_term == b.volume_term);
  CHECK(a.viscosity == b.viscosity);
  CHECK(a.bulk_viscosity == b.bulk_viscosity);
  REQUIRE(a.relaxation.size() == b.relaxation.size());
  for (std::size_t i = 0; i < a.relaxation.size(); ++i) {
    CHECK(a.relaxation[i].gamma == b.relaxation[i].gamma);
    CHECK(a.relaxation[i].tau == b.relaxation[i].tau);
  }
  REQUIRE(a.plasticity.has_value() == b.plasticity.has_value());
  if (!a.plasticity) return;
  CHECK(a.plasticity->yield == b.plasticity->yield);
  CHECK(a.plasticity->hardening == b.plasticity->hardening);
}

/// Writes an entry as text and reads it back.
RegionMaterial reread(const RegionMaterial& entry) { return read(json_text(material_json(entry), "")); }

}  // namespace

TEST_CASE("reads the documented parameters of every law") {
  CHECK(read(R"({"law": "stvk", "lambda": 3, "mu": 2})").material.parameters == Values{3, 2});
  CHECK(read(R"({"law": "neo_hookean", "mu": 2, "lambda": 3})").material.parameters == Values{3, 2});
  CHECK(read(R"({"law": "neo_hookean_iso", "K1": 1, "kappa": 20})").material.parameters == Values{1, 20});
  CHECK(read(R"({"law": "mooney_rivlin", "kappa": 20, "K2": 2, "K1": 1})").material.parameters == Values{1, 2, 20});
  CHECK(read(R"({"law": "fung_demiray", "mu": 1, "gamma": 2, "kappa": 20})").material.parameters == Values{1, 2, 20});
  const Material ogden =
      read(R"({"law": "ogden", "kappa": 20, "alpha": [2, -3, 4.5], "mu": [1, -0.25, 0.5]})").material;
  CHECK(ogden.parameters == Values{1, -0.25, 0.5, 2, -3, 4.5, 20});
  const Material hgo = read(R"({"law": "hgo", "K1": 1, "kappa": 20, "k1": 3, "k2": 4, "fibre": [0, 3, 4]})").material;
  CHECK(hgo.parameters == Values{1, 20, 3, 4});
  CHECK((hgo.fibre - Vec3(0, 0.6, 0.8)).norm() < 1e-15);
  CHECK(read(R"({"law": "mass_spring", "stiffness": 5, "density": 900})").material.parameters == Values{5});
}

TEST_CASE("reads what acts beside elasticity") {
  const Material material = read(R"({"law": "neo_hookean_iso", "K1": 1, "kappa": 20, "volume_term": "simo_taylor",
    "viscosity": 0.5, "bulk_viscosity": 0.25, "relaxation": [{"gamma": 0.3, "tau": 0.1}, {"gamma": 0.2, "tau": 2}],
    "plasticity": {"yield": 7, "hardening": 3}})")
                                .material;
  CHECK(material.volume_term == VolumeTerm::simo_taylor);
  CHECK(material.viscosity == 0.5);
  CHECK(material.bulk_viscosity == 0.25);
  REQUIRE(material.relaxation.size() == 2);
  CHECK(material.relaxation[1].gamma == 0.2);
  CHECK(material.relaxation[1].tau == 2);
  REQUIRE(material.plasticity);
  CHECK(material.plasticity->yield == 7);
  CHECK(material.plasticity->hardening == 3);
  CHECK(read(R"({"law": "stvk", "lambda": 3, "mu": 2, "viscosity": 1})").material.viscosity == 1);
  const Material plain = read(R"({"law": "neo_hookean_iso", "K1": 1, "kappa": 20})").material;
  CHECK(plain.volume_term == VolumeTerm::quadratic);
  CHECK_FALSE(plain.has_internal_state());
}

TEST_CASE("reads fields for numbers and fibres") {
  const Material material = read(R"({"law": "hgo", "K1": {"field": "K"}, "kappa": 20, "k1": {"field": "f"}, "k2": 4,
    "fibre": {"field": "direction"}})")
                                .material;
  CHECK(material.fibre_field == "direction");
  REQUIRE(material.fields.size() == 2);
  CHECK(material.fields[0].parameter == 0);
  CHECK(material.fields[0].field == "K");
  CHECK(material.fields[1].parameter == 2);
  CHECK(material.fields[1].field == "f");
  const Material ogden = read(R"({"law": "ogden", "mu": [1, 2], "alpha": [2, 3], "kappa": {"field": "K"}})").material;
  REQUIRE(ogden.fields.size() == 1);
  CHECK(ogden.fields[0].parameter == 4);
}

TEST_CASE("reads young and poisson as fields: lambda and mu take fields named after what makes them") {
  const Material material = read(R"({"law": "stvk", "young": {"field": "E \" 1"}, "poisson": 0.45})").material;
  REQUIRE(material.fields.size() == 2);
  CHECK(material.fields[0].field == R"(lambda {"young": {"field": "E \" 1"}, "poisson": 0.45000000000000001})");
  CHECK(material.fields[1].parameter == 1);
  const auto pair = young_poisson_behind(material.fields[1].field);
  REQUIRE(pair);
  CHECK(pair->young.field == "E \" 1");
  CHECK(pair->poisson.field.empty());
  CHECK(pair->poisson.value == 0.45);
  for (const char* name : {"E", "lambda", "lambda {", "mu {}", R"(mu {"young": 1, "poisson": 0.5})",
                           R"(kappa {"young": 1, "poisson": 0.3})", "mu x {\"young\": 1, \"poisson\": 0.3}"})
    CHECK_FALSE(young_poisson_behind(name));
}

TEST_CASE("writes every law so that it reads back bit for bit") {
  for (const LawInfo& law : laws()) {
    RegionMaterial entry{7, test::sample_material(law.name)};
    for (double& value : entry.material.parameters) value *= 1 + 1.0 / 3 * 1e-3;
    entry.material.density = 1000.0 / 3;
    if (law.has_fibre) entry.material.fibre = Vec3(1, 2, 3).normalized();
    CAPTURE(law.name);
    expect_same(reread(entry).material, entry.material);
    CHECK(reread(entry).region == 7);
  }
}

TEST_CASE("writes fields, memory and volume terms so that they read back") {
  for (
      const char* text :
      {R"({"law": "hgo", "K1": {"field": "K"}, "kappa": 20, "k1": 3, "k2": 4, "fibre": {"field": "a b"}})",
       R"({"law": "ogden", "mu": [1, 2], "alpha": [2, 3], "kappa": {"field": "K"}, "volume_term": "logarithmic"})",
       R"({"law": "stvk", "young": {"field": "E"}, "poisson": {"field": "nu"}})",
       R"({"law": "neo_hookean", "young": 3e3, "poisson": {"field": "nu"}, "viscosity": 0.1, "bulk_viscosity": 3})",
       R"({"law": "neo_hookean", "lambda": {"field": "l"}, "mu": 4})",
       R"({"law": "mass_spring", "stiffness": {"field": "k"}})",
       R"({"law": "neo_hookean", "lambda": 1, "mu": 4, "fibre": [0, 3, 4], "active_stress": 6e4})",
       R"({"law": "neo_hookean", "lambda": 1, "mu": 4, "fibre": {"field": "a"}, "active_stress": 0})",
       R"({"law": "guccione", "C": 1, "bf": 2, "bt": 3, "bfs": 4, "kappa": 9, "fibre": [1, 0, 0], "active_stress": 5})",
       R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "relaxation": [{"gamma": 0.3, "tau": 0.1}],
               "plasticity": {"yield": 7}})"}) {
    CAPTURE(text);
    const RegionMaterial entry = read(text);
    expect_same(reread(entry).material, entry.material);
  }
  const RegionMaterial pair = read(R"({"law": "stvk", "young": {"field": "E"}, "poisson": 0.25, "density": 1})");
  CHECK(json_text(material_json(pair), "") ==
        R"({"law": "stvk", "young": {"field": "E"}, "poisson": 0.25, "density": 1.0})");
}

TEST_CASE("refuses mistakes in a material with the key and what would be right") {
  const struct {
    const char *text, *place, *remedy;
  } mistakes[] = {
      {R"({"law": "hook"})", "law: is \"hook\"", "did you mean '"},
      {R"({"law": "ogden", "mu": 1, "alpha": [2], "kappa": 9})", "mu: is 1", "must be a list [ ... ]"},
      {R"({"law": "ogden", "mu": {"field": "m"}, "alpha": [2], "kappa": 9})", "mu: is {", "must be a list [ ... ]"},
      {R"({"law": "ogden", "mu": [], "alpha": [], "kappa": 9})", "mu: is empty", "one number a term"},
      {R"({"law": "ogden", "mu": [1, 2], "alpha": [2], "kappa": 9})", "alpha: has 1 numbers, 'mu' has 2",
       "as many of each"},
      {R"({"law": "ogden", "mu": [1, "2"], "alpha": [2, 3], "kappa": 9})", "mu[1]: is \"2\"", "must be a number"},
      {R"({"law": "neo_hookean_iso", "K1": [1], "kappa": 9})", "K1: is [1]", "must be a number"},
      {R"({"law": "neo_hookean_iso", "K1": {"feld": "a"}, "kappa": 9})", "K1.feld: unknown key", "'field'"},
      {R"({"law": "neo_hookean_iso", "K1": {"field": ""}, "kappa": 9})", "K1.field: is \"\"", "name of a field"},
      {R"({"law": "neo_hookean_iso", "K1": {"field": 3}, "kappa": 9})", "K1.field: is 3", "a text"},
      {R"({"law": "neo_hookean_iso", "K1": 1, "kappa": 9, "fibre": [1, 0, 0]})", "fibre: does not go with the law",
       "it goes with hgo"},
      {R"({"law": "hgo", "K1": 1, "kappa": 9, "k1": 1, "k2": 1})", "'fibre' is missing", "add \"fibre\""},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "active_stress": 1})", "'fibre' is missing", "add \"fibre\""},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "active_stress": -1, "fibre": [1, 0, 0]})", "active_stress: is -1",
       "0 or greater"},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "active_stress": {"field": "a"}, "fibre": [1, 0, 0]})",
       "active_stress: is {", "a number"},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "active_stress": 1, "fibre": [0, 0, 0]})", "fibre: is [0,0,0]",
       "not all of its numbers 0"},
      {R"({"law": "mass_spring", "stiffness": 1, "active_stress": 1})", "active_stress: does not go with", "stvk"},
      {R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "plasticity": {"yield": 1}, "active_stress": 1,
           "fibre": [1, 0, 0]})",
       "plasticity: is for materials without active stress", ""},
      {R"({"law": "hgo", "K1": 1, "kappa": 9, "k1": 1, "k2": 1, "fibre": [0, 0, 0]})", "fibre: is [0,0,0]",
       "not all of its numbers 0"},
      {R"({"law": "hgo", "K1": 1, "kappa": 9, "k1": 1, "k2": 1, "fibre": "x"})", "fibre: is \"x\"", "three numbers"},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "volume_term": "quadratic"})", "volume_term: does not go with",
       "neo_hookean_iso"},
      {R"({"law": "neo_hookean_iso", "K1": 1, "kappa": 9, "volume_term": "quadratc"})", "volume_term: is \"quadratc\"",
       "did you mean 'quadratic'?"},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "viscosity": -1})", "viscosity: is -1", "0 or greater"},
      {R"({"law": "stvk", "lambda": 1, "mu": 1, "relaxation": [{"gamma": 1, "tau": 1}]})", "relaxation: does not go",
       "mooney_rivlin"},
      {R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "relaxation": [{"gamma": 1}]})",
       "relaxation[0]: 'tau' is missing", "add \"tau\""},
      {R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "relaxation": [{"gamma": 0, "tau": 1}]})",
       "relaxation[0].gamma: is 0", "greater than 0"},
      {R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "plasticity": {"yield": 0}})", "plasticity.yield: is 0",
       "greater than 0"},
      {R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "plasticity": {"yield": 1, "hardening": -1}})",
       "plasticity.hardening: is -1", "0 or greater"},
      {R"({"law": "gent", "mu": 1, "Jm": 3, "kappa": 9, "plasticity": {"yield": 1, "hardning": 1}})",
       "plasticity.hardning: unknown key", "did you mean 'hardening'?"},
      {R"({"law": "mass_spring", "stiffness": 1, "viscosity": 1})", "viscosity: does not go with", "stvk"},
      {R"({"law": "mass_spring", "stiffness": 1, "young": 1})", "young: unknown key", "Keys here: law"},
      {R"({"law": "mass_spring", "stiffness": 0})", "stiffness: must be greater than 0", ""},
      {R"({"law": "neo_hookean_iso", "K1": 1, "kappa": -9})", "kappa: must be greater than 0", ""},
      {R"({"law": "stvk", "young": {"field": "E"}})", "'poisson' is missing", "add \"poisson\""},
      {R"({"law": "stvk", "young": {"field": "E"}, "poisson": 0.5})", "poisson: is 0.5", "like 0.49"},
      {R"({"law": "stvk", "young": {"field": "E"}, "mu": 0.5})", "mixes young, poisson with lambda, mu", "one pair"},
      {R"({"law": "stvk", "young": 1, "poisson": 0.3, "relaxtion": []})", "relaxtion: unknown key", "Keys here"},
  };
  for (const auto& mistake : mistakes) {
    const std::string message = refusal([&] { read(mistake.text); });
    CAPTURE(mistake.text);
    CAPTURE(message);
    CHECK(message.starts_with(std::string("m.json: ") + mistake.place));
    CHECK(says(message, mistake.remedy));
  }
}

TEST_CASE("refuses fields where there is no mesh") {
  const TemporaryFolder folder;
  const auto told = [&](const char* text) {
    const auto path = folder.file("m.json", text);
    return refusal([&] { read_material(path); });
  };
  CHECK(says(told(R"({"law": "stvk", "young": {"field": "E"}, "poisson": 0.3})"), "there is no mesh here"));
  CHECK(says(told(R"({"law": "hgo", "K1": 1, "kappa": 9, "k1": 1, "k2": 1, "fibre": {"field": "f"}})"),
                   "there is no mesh here"));
}

}  // namespace heml::material_json_test
