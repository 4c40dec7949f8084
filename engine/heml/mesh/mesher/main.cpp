// heml-mesher read SURFACE
// heml-mesher skin SURFACE
// heml-mesher fill RADIUS_EDGE_RATIO MAX_VOLUME|none
//
// Helper process that the engine runs under limits on time and memory. Reads the surface to fill from stdin and writes
// the answer to file descriptor 3, since the libraries print to stdout. Exit codes: 0 success; 1 failure, with a
// message on stderr; 2 out of memory.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <new>
#include <vector>

#include "exchange.hpp"

namespace mesher {

Exchange read_exchange(std::istream& in, int row) {
  std::size_t nodes = 0, rows = 0, holes = 0;
  in >> nodes >> rows >> holes;
  Exchange exchange;
  if (in) exchange = {std::vector<double>(3 * nodes), std::vector<int>(row * rows), std::vector<double>(3 * holes)};
  for (double& value : exchange.nodes) in >> value;
  for (int& value : exchange.rows) in >> value;
  for (double& value : exchange.holes) in >> value;
  if (!in) throw Failure("the helper cannot read its input");
  return exchange;
}

void write_exchange(std::FILE* file, const Exchange& exchange, int row) {
  std::fprintf(file, "%zu %zu\n", exchange.nodes.size() / 3, exchange.rows.size() / row);
  for (std::size_t i = 0; i < exchange.nodes.size(); ++i)
    std::fprintf(file, i % 3 < 2 ? "%.17g " : "%.17g\n", exchange.nodes[i]);
  for (std::size_t i = 0; i < exchange.rows.size(); ++i)
    std::fprintf(file, (i + 1) % row ? "%d " : "%d\n", exchange.rows[i]);
  const bool failed = std::ferror(file);
  if (std::fclose(file) != 0 || failed) throw Failure("the helper cannot write its answer");
}

#ifndef HEML_ASSIMP
Exchange read_surface(const std::string&) {
  throw Failure("this build does not read surfaces (build with HEML_ASSIMP on)");
}
Skin read_skin(const std::string&) {
  throw Failure("this build does not read surfaces (build with HEML_ASSIMP on)");
}
void write_skin(std::FILE*, const Skin&) {}
#endif
#ifndef HEML_TETGEN
Exchange fill_surface(const Exchange&, double, double) {
  throw Failure("this build does not fill surfaces (build with HEML_TETGEN on)");
}
#endif

static void run(const std::vector<std::string>& words) {
  std::FILE* answer = fdopen(3, "wb");
  if (answer && words.size() == 2 && words[0] == "read") {
    write_exchange(answer, read_surface(words[1]), 3);
  } else if (answer && words.size() == 2 && words[0] == "skin") {
    write_skin(answer, read_skin(words[1]));
  } else if (answer && words.size() == 3 && words[0] == "fill") {
    const double ratio = std::strtod(words[1].c_str(), nullptr);
    const double max_volume = words[2] == "none" ? 0 : std::strtod(words[2].c_str(), nullptr);
    std::ios::sync_with_stdio(false);
    write_exchange(answer, fill_surface(read_exchange(std::cin, 3), ratio, max_volume), 4);
  } else {
    throw Failure("heml-mesher is run by heml, see heml mesh --help");
  }
}

}  // namespace mesher

// Memory that the libraries lose ends with this process: to a sanitizer it would be a failure, in place of the answer.
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "detect_leaks=0"; }

int main(int count, char** words) try {
  mesher::run({words + 1, words + count});
  return EXIT_SUCCESS;
} catch (const mesher::Failure& failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return EXIT_FAILURE;
} catch (const std::bad_alloc&) {
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "the helper failed: %s\n", error.what());
  return EXIT_FAILURE;
}
