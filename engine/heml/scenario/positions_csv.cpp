#include <fmt/format.h>

#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/csv_text.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/positions_csv.hpp>
#include <heml/scenario/text_file.hpp>
#include <string>
#include <string_view>

namespace heml {
namespace {

constexpr std::string_view header = "node,x,y,z";

}  // namespace

std::vector<Vec3> read_positions_csv(const std::filesystem::path& path, int nodes) {
  const std::string content = read_text_file(path);
  std::string_view text = content;
  const auto fail = [&](long line, const std::string& problem, const std::string& remedy) {
    throw InputError(path.string(), fmt::format("line {}", line), problem, remedy);
  };
  if (const std::string_view first = consume_line(text); first != header)
    fail(1, fmt::format("is '{}'", shown(first)), fmt::format("must be the header {}", header));
  std::vector<Vec3> positions(static_cast<std::size_t>(nodes), Vec3::Zero());
  std::vector<bool> given(positions.size(), false);
  int count = 0;
  for (long line = 2; !text.empty(); ++line) {
    const std::string_view entry = consume_line(text);
    if (is_blank(entry)) continue;
    std::string_view rest = entry;
    int node = -1;
    Vec3 x;
    const bool read = consume_number(rest, node) && consume_number(rest, x[0]) && consume_number(rest, x[1]) &&
                      consume_number(rest, x[2]);
    if (!read || !rest.empty() || !x.allFinite())
      fail(line, fmt::format("is '{}'", shown(entry)), "must be node,x,y,z: four numbers");
    if (node < 0 || node >= nodes)
      fail(line, fmt::format("is of node {}", node), fmt::format("the mesh has nodes 0 to {}", nodes - 1));
    if (given[node]) fail(line, fmt::format("is of node {} once more", node), "give every node once");
    given[node] = true;
    positions[node] = x;
    ++count;
  }
  if (count != nodes)
    throw InputError(path.string(), "", fmt::format("gives {} of {} nodes", count, nodes), "give every node");
  return positions;
}

void write_positions_csv(const std::filesystem::path& path, const std::vector<Vec3>& positions) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}\n", header);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3& x = positions[i];
    fmt::format_to(std::back_inserter(text), "{},{:.17g},{:.17g},{:.17g}\n", i, x.x(), x.y(), x.z());
  }
  write_file(path, std::string_view(text.data(), text.size()));
}

}  // namespace heml
