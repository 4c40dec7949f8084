#include "app/render/png.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <heml/base/error.hpp>
#include <places.hpp>
#include <string>

namespace heml::png_test {

using namespace heml::render;

namespace {

const std::filesystem::path folder = test::build_folder() / "png_test";

Image pattern() {
  Image image({37, 23});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * i % 251);
  return image;
}

}  // namespace

TEST_CASE("an image written as PNG reads back byte for byte") {
  std::filesystem::create_directories(folder);
  const Image image = pattern();
  write_png(folder / "pattern.png", image);
  const Image back = read_png(folder / "pattern.png");
  CHECK(back.size == image.size);
  CHECK(back.pixels == image.pixels);
  CHECK(rms_difference(image, back) == 0);
}

TEST_CASE("the difference of images is a root mean square over channels") {
  Image a({10, 10}), b({10, 10});
  b.at(3, 4)[1] = 30;
  CHECK(rms_difference(a, b) == doctest::Approx(std::sqrt(900.0 / 300)));
  CHECK_THROWS_AS(rms_difference(a, Image({5, 20})), std::invalid_argument);
}

TEST_CASE("refuses files that are missing, not PNG, or cut short") {
  std::filesystem::create_directories(folder);
  CHECK_THROWS_AS(read_png(folder / "missing.png"), InputError);
  std::ofstream(folder / "text.png") << "not a picture at all";
  CHECK_THROWS_WITH_AS(read_png(folder / "text.png"), doctest::Contains("text.png: not a sound PNG"), InputError);
  write_png(folder / "whole.png", pattern());
  std::ifstream whole(folder / "whole.png", std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(whole), {});
  std::ofstream(folder / "cut.png", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  CHECK_THROWS_AS(read_png(folder / "cut.png"), InputError);
}

TEST_CASE("refuses to write into a missing folder") {
  CHECK_THROWS_AS(write_png(folder / "no" / "such" / "place.png", pattern()), InputError);
}

}  // namespace heml::png_test
