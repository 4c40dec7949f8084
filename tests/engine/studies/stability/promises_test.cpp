// Promises may be added and tightened, never removed or loosened.
#include <doctest/doctest.h>

#include <filesystem>
#include <heml/base/write_file.hpp>
#include <heml/scenario/text_file.hpp>
#include <map>
#include <places.hpp>
#include <studies/stability/matrix.hpp>
#include <studies/stability/report.hpp>

namespace heml::promises_test {

using namespace heml::stability;

namespace {

const std::filesystem::path committed = test::source_folder() / "assets/studies/promised.json";

/// Loosest limits allowed in double and in float, and the least number of promised variants of a case.
struct Floor {
  double limit, float_limit;
  int variants;
};
const std::map<int, Floor> floors = {
    {1, {1e-06, 1e-05, 24}},   {2, {1e-05, 1e-05, 24}},   {3, {1e-10, 1e-05, 24}},   {4, {1e-09, 1e-09, 12}},
    {5, {1e-12, 1e-06, 24}},   {6, {1e-10, 2e-05, 132}},  {7, {0.1, 0, 12}},         {8, {0.2, 0, 11}},
    {9, {0.01, 0.01, 40}},     {10, {1e-05, 0.001, 44}},  {11, {1e-09, 1e-05, 20}},  {12, {1e-06, 1e-06, 66}},
    {13, {0.001, 0.001, 108}}, {14, {0, 0, 22}},          {15, {0.001, 0.001, 110}}, {16, {60, 60, 10}},
    {17, {8, 8, 104}},         {18, {0, 0, 21}},          {19, {0.0001, 0.01, 26}},  {20, {0.01, 0.01, 104}},
    {21, {0.12, 0.12, 7}},     {22, {0.05, 0.05, 76}},    {23, {0.01, 0.01, 48}},    {24, {1e-06, 1e-05, 6}},
    {25, {1e-05, 1e-05, 2}},   {26, {0.001, 0.001, 120}}, {27, {0.01, 0.01, 72}},    {28, {1e-09, 1e-05, 108}},
    {29, {1e-09, 1e-05, 142}}, {30, {1e-09, 1e-05, 178}}, {31, {1e-09, 1e-05, 178}}, {32, {0, 0, 144}},
    {33, {1e-05, 0.0001, 8}}};

std::filesystem::path folder(const char* name) {
  const auto path = test::build_folder() / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

Cell cell_of(Verdict verdict, double value) {
  Cell cell{10, {"ogden", Integrator::verlet, false}, {value}, verdict};
  return cell;
}

const Promise drift{10, Integrator::verlet, false, 1e-5, {"stvk", "ogden"}};

}  // namespace

TEST_CASE("the list of promises has not shrunk and no limit is looser than the reference") {
  std::map<int, int> variants;
  for (const Promise& promise : read_promises(committed)) {
    CAPTURE(promise.number);
    REQUIRE(floors.contains(promise.number));
    variants[promise.number] += static_cast<int>(promise.laws.size());
    const Case& c = case_numbered(promise.number);
    const Floor& floor = floors.at(promise.number);
    CHECK(promise.limit <= (promise.single ? floor.float_limit : floor.limit));
    CHECK(promise.limit <= c.limit_of({"", promise.integrator, promise.single}));
    const auto known = variants_of(c, false);
    for (const std::string& law : promise.laws)
      CHECK_MESSAGE(std::count(known.begin(), known.end(), CaseVariant{law, promise.integrator, promise.single}) == 1,
                    law);
  }
  for (const auto& floor : floors) {
    CAPTURE(floor.first);
    CHECK(variants[floor.first] >= floor.second.variants);
  }
}

TEST_CASE("no limit of the table is looser than the reference") {
  for (const Case& c : cases()) {
    CHECK_MESSAGE(c.limit <= floors.at(c.number).limit, c.name);
    CHECK_MESSAGE(!(c.float_limit > floors.at(c.number).float_limit), c.name);
  }
}

TEST_CASE("forces and collapse of every law are promised in double") {
  const auto promises = read_promises(committed);
  const auto promised = [&](int number, std::string_view law, std::optional<Integrator> integrator) {
    for (const Promise& promise : promises)
      if (promise.number == number && promise.integrator == integrator && !promise.single &&
          std::find(promise.laws.begin(), promise.laws.end(), law) != promise.laws.end())
        return true;
    return false;
  };
  for (const auto law : study_laws())
    for (const int number : {1, 2, 3, 4, 5}) CHECK_MESSAGE(promised(number, law, std::nullopt), number, " ", law);
  for (const auto law : continua())
    for (const int number : {13, 15})
      CHECK_MESSAGE(promised(number, law, Integrator::backward_euler), number, " ", law);
  CHECK(promised(14, "stvk", Integrator::backward_euler));
}

TEST_CASE("a verdict needs more than being finite") {
  CHECK(judge({0.5}, 1) == Verdict::stable);
  CHECK(judge({2}, 1) == Verdict::wrong);
  CHECK(judge({0.5, 3}, 1) == Verdict::inverted);
  CHECK(judge({0.5, 0, 1}, 1) == Verdict::recovered);
  CHECK(judge({0.5, 0, 0, "ran away"}, 1) == Verdict::diverged);
  CHECK(judge({0.5, 0, 0, "", "not balanced"}, 1) == Verdict::wrong);
  CHECK(judge({std::numeric_limits<double>::quiet_NaN()}, 1) == Verdict::diverged);
  const Outcome proven{2, 3, 0, "", "", "", "a limit point"};
  CHECK(judge(proven, 2) == Verdict::unsolvable);
  CHECK(judge({1, 0, 0, "stopped", "", "", "a limit point"}, 2) == Verdict::unsolvable);
  CHECK(judge({1, 0, 0, "", "", "", "a limit point"}, 2) == Verdict::stable);
  CHECK(worse(proven, {1, 2}).proof.empty());  // the other has none
  CHECK(worse({1}, proven).proof == "a limit point");
  CHECK(worse({1}, {2, 0, 0, "ran away"}).stopped == "ran away");
  CHECK(worse({std::numeric_limits<double>::quiet_NaN()}, {2}).value != 2);
}

TEST_CASE("a promise can fall short by its verdict or by its value alone") {
  std::vector<Cell> cells = {cell_of(Verdict::stable, 1e-6), cell_of(Verdict::stable, 2e-5),
                             cell_of(Verdict::inverted, 1e-6), cell_of(Verdict::wrong, 1)};
  cells[3].variant.law = "gent";  // not among the promised laws
  check_promises({drift}, cells);
  CHECK(cells[0].promised);
  CHECK_FALSE(cells[0].short_of_promise);
  CHECK(cells[1].short_of_promise);
  CHECK(cells[2].short_of_promise);
  CHECK_FALSE(cells[3].promised);
  CHECK_FALSE(cells[3].short_of_promise);
  CHECK(shortfalls(cells).size() == 2);
  CHECK(answer(cells).starts_with("1 of 3 promised runs hold; the others fall short"));
}

TEST_CASE("passing cells can be promised as they are and read back") {
  const auto file = folder("promises") / "holding.json";
  write_file(file, promises_text({cell_of(Verdict::stable, 1e-6), cell_of(Verdict::diverged, 1)}));
  const auto promises = read_promises(file);
  REQUIRE(promises.size() == 1);
  CHECK(promises[0].number == 10);
  CHECK(promises[0].integrator == Integrator::verlet);
  CHECK(promises[0].limit == 1e-5);
  CHECK(promises[0].laws == std::vector<std::string>{"ogden"});
}

TEST_CASE("an interrupted study continues and keeps its results") {
  StudyOptions options;
  options.only = {5};
  int runs = 0;
  options.progress = [&](const std::string&, double) { ++runs; };
  const auto results = folder("study") / "results.jsonl";
  const auto first = run_study(results, options);
  CHECK(runs == static_cast<int>(first.size()));
  const std::string text = read_text_file(results);
  write_file(results, text.substr(0, text.size() / 2));  // ends in the middle of a line
  runs = 0;
  const auto second = run_study(results, options);
  CHECK(runs > 0);
  CHECK(runs < static_cast<int>(first.size()));
  for (std::size_t k = 0; k < first.size(); ++k) CHECK(first[k].outcome.value == second[k].outcome.value);
}

TEST_CASE("the matrix and the report show every run, its promise, and what falls short") {
  std::vector<Cell> cells = {cell_of(Verdict::stable, 1e-6), cell_of(Verdict::inverted, 1e-6)};
  cells[1].variant.law = "stvk";
  check_promises({drift}, cells);
  const std::string svg = matrix_svg(cells);
  CHECK(svg.find(">S</text>") != std::string::npos);
  CHECK(svg.find(">I</text>") != std::string::npos);
  CHECK(svg.find("#c00020") != std::string::npos);
  const std::string page = html_report(cells, {}, true);
  for (const char* part : {"Falls short: case 10", "<svg", "What does not hold", "Signed penalty volumes"})
    CHECK_MESSAGE(page.find(part) != std::string::npos, part);
}

TEST_CASE("a penalty costs what a continuation does not, and recovery brings back what either leaves") {
  for (const PenaltyRow& row : compare_with_penalty(true)) {
    CAPTURE(row.method);
    if (row.method.find("penalty") != std::string::npos) {
      CHECK(row.changed_stress > 0.001);
      CHECK(row.max_step < 1);
    } else {
      CHECK(row.changed_stress == 0);
      CHECK(row.max_step == doctest::Approx(1));
    }
    if (row.method == "StVK alone") CHECK_FALSE(row.back());
    if (row.method == "Neo-Hookean, engine's recovery") CHECK(row.back());
  }
}

}  // namespace heml::promises_test
