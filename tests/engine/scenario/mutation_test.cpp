// Scenes and recordings with random mutations: the reader returns a scene or throws InputError.
#include <doctest/doctest.h>

#include <engine/scenario/samples.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/scene.hpp>
#include <random>

namespace heml::mutation_test {
namespace {

const char* const pieces[] = {"{",
                              "}",
                              "[",
                              "]",
                              ",",
                              ":",
                              "\"",
                              "null",
                              "true",
                              "\\u0000",
                              "-1",
                              "0",
                              "1e999",
                              "-0.0",
                              "1e308",
                              "NaN",
                              "[[[[",
                              "0.5",
                              "\n",
                              "\"end\": true",
                              "99999999999999999999",
                              "\xff",
                              "\"step\""};

std::string sample() {
  return test::scene_with(R"({
    "materials": [{"law": "stvk", "young": {"field": "E"}, "poisson": 0.3},
      {"region": 1, "law": "gent", "mu": 1, "Jm": {"field": "J"}, "kappa": 9, "plasticity": {"yield": 1}}],
    "loads": [{"sphere": [[0.2, 0, 0], 0.05], "traction": [0, 1, 0]}], "outputs": {"times": [0.05]},
    "view": {"field": "stretch"}, "events": [{"at": 0.02, "grasp": {"point": [0.2, 0, 0], "radius": 0.01}},
    {"step": 4, "material": {"law": "neo_hookean", "lambda": 10, "mu": 5}}]})") +
         R"(
{"step": 3, "move": [0.1, 0.2, 0.3]}
{"step": 5, "checkpoint": "0123456789abcdef", "nodes": "0123"}
{"step": 6, "material": {"law": "ogden", "mu": [1, 2], "alpha": [2, -2], "kappa": 9, "viscosity": 1}}
{"step": 7, "material": {"law": "hgo", "K1": 1, "kappa": 9, "k1": 1, "k2": 1, "fibre": [0, 0, 1]}}
{"step": 7, "material": {"law": "yeoh", "C10": 1, "C20": 1, "C30": 1, "kappa": 9, "volume_term": "logarithmic"}}
{"step": 9, "end": true}
)";
}

void damage(std::string& text, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t at = below(text.size() + 1), length = below(20);
  switch (below(5)) {
    case 0:
      text.erase(at, length);
      break;
    case 1:
      text.insert(at, pieces[below(std::size(pieces))]);
      break;
    case 2:
      text.insert(at, text.substr(below(text.size() + 1), length));
      break;
    case 3:
      text.resize(at);
      break;
    default:
      if (at < text.size()) text[at] = static_cast<char>(below(256));
  }
}

}  // namespace

TEST_CASE("answers damaged scenes with a scene or an InputError and nothing else") {
  std::mt19937_64 random(20060101);
  int read = 0, refused = 0;
  for (int round = 0; round < 5000; ++round) {
    std::string text = sample();
    const std::size_t times = 1 + random() % 3;
    for (std::size_t i = 0; i < times && !text.empty(); ++i) damage(text, random);
    try {
      parse_scene(text, "damaged.jsonl");
      ++read;
    } catch (const InputError& error) {
      ++refused;
      const std::string message = error.what();
      CHECK(message.starts_with("damaged.jsonl: "));
      CHECK(message.find('\n') == message.npos);
    }
  }
  CHECK(read > 100);  // some mutations pass the parser
  CHECK(refused > 1000);
}

}  // namespace heml::mutation_test
