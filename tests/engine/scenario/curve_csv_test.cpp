#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/curve_csv.hpp>

#include "samples.hpp"

namespace heml::curve_csv_test {

namespace {

/// Deletes a file in its destructor.
struct Removed {
  std::filesystem::path path;
  ~Removed() { std::filesystem::remove(path); }
};

MeasuredCurve read(const std::string& text, const MeasuredTest& test = BenchTest::uniaxial) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("heml-curve-test-{}.csv", getpid());
  write_file(path, text);
  const Removed removed{path};
  return read_curve_csv(path, test);
}

std::string refusal(const std::string& text, const MeasuredTest& test = BenchTest::uniaxial) {
  try {
    read(text, test);
  } catch (const InputError& error) {
    return error.what();
  }
  FAIL("was read: ", text);
  return {};
}

}  // namespace

TEST_CASE("reads two columns under the header of the test") {
  const MeasuredCurve data = read("# pulled by hand\nstretch,stress\r\n 1.1 , 100\n\n1.2,\t2.5e2\n");
  CHECK(data.amount == std::vector<double>{1.1, 1.2});
  CHECK(data.stress == std::vector<double>{100, 250});
  CHECK(read("\xEF\xBB\xBFstretch,stress\n1.1,100\n").stress == std::vector<double>{100});
  CHECK(read("gamma,stress\n-0.1,-5", BenchTest::shear).amount == std::vector<double>{-0.1});
  CHECK(read("time,stress\n0,5\n1,4", Relaxation{}).stress == std::vector<double>{5, 4});
}

TEST_CASE("refuses what is no measured curve, naming the line") {
  CHECK(says(refusal("1.1,100\n"), "line 1"));
  CHECK(says(refusal("1.1,100\n"), "stretch,stress"));
  CHECK(says(refusal("time,stress\n1,2\n"), "stretch,stress"));
  CHECK(says(refusal("stretch,stress\n1,2\n", BenchTest::shear), "gamma,stress"));
  CHECK(says(refusal("stretch,stress\n1.1,100\n1.2\n"), "line 3"));
  CHECK(says(refusal("stretch,stress\n1.1,nan\n"), "line 2"));
  CHECK(says(refusal("stretch,stress\n1.1,100,5\n"), "line 2"));
  CHECK(says(refusal("stretch,stress\n-1.1,100\n"), "greater than 0"));
  CHECK(says(refusal("time,stress\n-1,100\n", Relaxation{}), "0 or more"));
  CHECK(says(refusal("stretch,stress\n"), "no measured point"));
  CHECK(says(refusal(""), "no measured point"));
  std::string many = "stretch,stress\n";
  for (int k = 0; k < 5001; ++k) many += "1.1,5\n";
  CHECK(says(refusal(many), "line 5002"));
}

}  // namespace heml::curve_csv_test
