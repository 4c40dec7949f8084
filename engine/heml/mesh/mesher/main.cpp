// heml-mesher read SURFACE OUT
// heml-mesher fill SURFACE OUT RADIUS_EDGE_RATIO MAX_VOLUME|none
//
// Run by the engine under limits on time and memory; not for people. Exit codes: 0 done; 1 a reason on stderr.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <new>
#include <vector>

#include "exchange.hpp"

namespace mesher {

Exchange read_exchange(const std::string& path, int row) {
  std::ifstream in(path);
  std::size_t nodes = 0, rows = 0, holes = 0;
  in >> nodes >> rows >> holes;
  Exchange exchange;
  if (in) exchange = {std::vector<double>(3 * nodes), std::vector<int>(row * rows), std::vector<double>(3 * holes)};
  for (double& value : exchange.nodes) in >> value;
  for (int& value : exchange.rows) in >> value;
  for (double& value : exchange.holes) in >> value;
  if (!in) throw Failure("the helper cannot read its input " + path);
  return exchange;
}

void write_exchange(const std::string& path, const Exchange& exchange, int row) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) throw Failure("the helper cannot write " + path);
  std::fprintf(file, "%zu %zu\n", exchange.nodes.size() / 3, exchange.rows.size() / row);
  for (std::size_t i = 0; i < exchange.nodes.size(); ++i)
    std::fprintf(file, i % 3 < 2 ? "%.17g " : "%.17g\n", exchange.nodes[i]);
  for (std::size_t i = 0; i < exchange.rows.size(); ++i)
    std::fprintf(file, (i + 1) % row ? "%d " : "%d\n", exchange.rows[i]);
  const bool failed = std::ferror(file);
  if (std::fclose(file) != 0 || failed) throw Failure("the helper cannot write " + path);
}

#ifndef HEML_ASSIMP
Exchange read_surface(const std::string&) {
  throw Failure("this build does not read surfaces (build with HEML_ASSIMP on)");
}
#endif
#ifndef HEML_TETGEN
Exchange fill_surface(const Exchange&, double, double) {
  throw Failure("this build does not fill surfaces (build with HEML_TETGEN on)");
}
#endif

static int run(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[0] == "read") {
    write_exchange(words[2], read_surface(words[1]), 3);
  } else if (words.size() == 5 && words[0] == "fill") {
    const double ratio = std::strtod(words[3].c_str(), nullptr);
    const double max_volume = words[4] == "none" ? 0 : std::strtod(words[4].c_str(), nullptr);
    write_exchange(words[2], fill_surface(read_exchange(words[1], 3), ratio, max_volume), 4);
  } else {
    throw Failure("heml-mesher is run by heml, see heml mesh --help");
  }
  return EXIT_SUCCESS;
}

}  // namespace mesher

int main(int count, char** words) try {
  return mesher::run({words + 1, words + count});
} catch (const mesher::Failure& failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return EXIT_FAILURE;
} catch (const std::bad_alloc&) {
  std::fprintf(stderr, "the mesh takes too much memory\n");
  return EXIT_FAILURE;
} catch (const std::exception& error) {
  std::fprintf(stderr, "the helper failed: %s\n", error.what());
  return EXIT_FAILURE;
}
