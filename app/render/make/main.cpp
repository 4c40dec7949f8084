// make_tissue_texture SIDE FILE: writes the texture, which the build compiles in: made at start-up it would take half of
// the time until the first picture.
#include <app/render/make/tissue_texture.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>

int main(int argc, char** argv) {
  const int side = argc == 3 ? std::atoi(argv[1]) : 0;
  if (side < 1) {
    std::fputs("usage: make_tissue_texture SIDE FILE\n", stderr);
    return 2;
  }
  const auto texels = heml::render::tissue_texture(side);
  std::ofstream out(argv[2], std::ios::binary);
  out.write(reinterpret_cast<const char*>(texels.data()), static_cast<std::streamsize>(texels.size()));
  return out.flush() ? 0 : 1;
}
