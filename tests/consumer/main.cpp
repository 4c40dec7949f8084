// A soft bar held at one end sags under gravity, in a program outside heml's tree.
#include <cstdio>
#include <heml/mesh/generate.hpp>
#include <heml/world/world.hpp>

int main() {
  heml::WorldSetup setup;
  setup.mesh = heml::make_box({0.1, 0.02, 0.02}, {10, 2, 2});
  const heml::LameParameters lame = heml::lame_parameters(1e4, 0.45);
  setup.materials = {{std::nullopt, {"neo_hookean", {lame.lambda, lame.mu}, 1000.0}}};
  setup.gravity = {0, -9.81, 0};
  heml::Boundary wall;
  for (int v = 0; v < static_cast<int>(setup.mesh.nodes.size()); ++v)
    if (setup.mesh.nodes[v].x() == 0) wall.nodes.push_back(v);
  setup.boundary = {wall};

  const auto world = heml::make_world(setup);
  for (int k = 0; k < 50; ++k) world->tick();
  const double sag = setup.mesh.nodes.back().y() - world->positions().back().y();
  std::printf("the free end sank by %.3g mm in %.3g s, state %016llx\n", 1e3 * sag, world->time(),
              static_cast<unsigned long long>(world->state_hash()));
  return sag > 1e-3 && !world->halt() ? 0 : 1;
}
