#include <fmt/format.h>

#include <algorithm>
#include <studies/stability/matrix.hpp>
#include <studies/table.hpp>

namespace heml::stability {
namespace {

constexpr int left = 190, legend_height = 70, head = 58, cell_width = 13, row_height = 19, law_gap = 6;
// A column for each integrator but "auto", which is last.
constexpr int columns = static_cast<int>(integrator_count) - 1;

/// Colour-blind safe: colours differ in lightness too (after Okabe & Ito 2008).
struct Ink {
  const char *fill, *text;
  char letter;
};
constexpr Ink inks[] = {{"#cfe8de", "#1c2826", 'S'},   // stable
                        {"#56b4e9", "#10202c", 'R'},   // recovered
                        {"#d55e00", "#ffffff", 'I'},   // inverted
                        {"#222222", "#ffffff", 'D'},   // diverged
                        {"#f0e442", "#33300a", 'W'},   // wrong
                        {"#cc79a7", "#2a1020", 'N'}};  // no solution

/// Two panels, one above the other, with half of the laws each.
std::size_t laws_a_panel() { return (study_laws().size() + 1) / 2; }
int panel_height() { return head + static_cast<int>(cases().size()) * row_height + 24; }

int x_of(std::size_t law, bool single, int column) {
  return left + static_cast<int>(law % laws_a_panel()) * (2 * columns * cell_width + law_gap) +
         (single ? columns : 0) * cell_width + column * cell_width;
}
int top_of(std::size_t law) { return legend_height + static_cast<int>(law / laws_a_panel()) * panel_height(); }
int y_of(std::size_t law, std::size_t row) { return top_of(law) + head + static_cast<int>(row) * row_height; }

std::string text(double x, double y, int size, const char* anchor, const std::string& words,
                 const char* more = "fill=\"#1c2826\"") {
  return fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, size, anchor,
                     more, html_escaped(words));
}

std::string box(int x, int y, int width, const Ink& ink, bool promised, bool falls_short, const std::string& tip) {
  const char letter = promised ? ink.letter : static_cast<char>(ink.letter - 'A' + 'a');
  return fmt::format("<g><title>{}</title><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"{}/>",
                     html_escaped(tip), x + 0.5, y + 0.5, width - 1, row_height - 1, ink.fill,
                     falls_short ? " stroke=\"#c00020\" stroke-width=\"3\"" : "") +
         text(x + width / 2.0, y + row_height - 6, 10, "middle", std::string(1, letter),
              fmt::format("fill=\"{}\"", ink.text).c_str()) +
         "</g>\n";
}

std::string tip_of(const Cell& cell) {
  const Case& c = case_numbered(cell.number);
  return fmt::format("{} {}, {}: {}; {} {}, limit {}{}{}{}{}", cell.number, c.name, to_text(cell.variant),
                     verdict_name(cell.verdict), c.measured, short_number(cell.outcome.value),
                     short_number(c.limit_of(cell.variant)), cell.outcome.stopped.empty() ? "" : "; ",
                     cell.outcome.stopped, cell.outcome.broken.empty() ? "" : "; " + cell.outcome.broken,
                     cell.outcome.proof.empty() ? "" : "; " + cell.outcome.proof);
}

std::string heads() {
  std::string svg;
  for (std::size_t law = 0; law < study_laws().size(); ++law) {
    const int middle = x_of(law, true, 0);
    svg += text(middle, top_of(law) + 16, 13, "middle", std::string(study_laws()[law]));
    for (const bool single : {false, true}) {
      const double half = x_of(law, single, 0) + columns * cell_width / 2.0;
      svg += text(half, top_of(law) + 34, 11, "middle", single ? "float" : "double", "fill=\"#55645f\"");
      for (int k = 0; k < columns; ++k)
        svg += text(x_of(law, single, k) + cell_width / 2.0, top_of(law) + head - 6, 8, "middle",
                    all_integrators()[static_cast<std::size_t>(k)].code, "fill=\"#55645f\"");
    }
  }
  return svg;
}

std::string legend() {
  constexpr const char* words[] = {"stable",   "recovered",        "inverted",
                                   "diverged", "wrong but finite", "proven to have no solution"};
  std::string svg;
  int x = left;
  for (std::size_t k = 0; k < std::size(inks); ++k) {
    svg += box(x, 10, 20, inks[k], true, false, words[k]);
    svg += text(x + 26, 24, 13, "start", words[k]);
    x += 44 + 8 * static_cast<int>(std::string_view(words[k]).size());
  }
  return svg + text(left, 48, 12, "start",
                    "Capital letters are promised, a red frame falls short, empty is not asked. SE symplectic Euler, V "
                    "Verlet, "
                    "BE backward Euler, B2 BDF2, TR TR-BDF2, SD SDIRK2, ST static",
                    "fill=\"#55645f\"");
}

/// Row stripes and case names of one panel. first: its first law.
std::string rows(std::size_t first, int width) {
  std::string svg;
  for (std::size_t row = 0; row < cases().size(); ++row) {
    const int y = y_of(first, row);
    if (row % 2 == 0)
      svg +=
          fmt::format("<rect x=\"0\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#f4f6f5\"/>\n", y, width, row_height);
    svg += text(left - 8, y + row_height - 5, 12, "end", cases()[row].name);
    svg += text(6, y + row_height - 5, 12, "start", std::to_string(cases()[row].number), "fill=\"#55645f\"");
  }
  return svg;
}

}  // namespace

std::string matrix_svg(const std::vector<Cell>& cells) {
  const int width = x_of(laws_a_panel() - 1, true, columns) + 10, height = legend_height + 2 * panel_height();
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "stroke=\"none\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width, height);
  svg += legend() + rows(0, width) + rows(laws_a_panel(), width) + heads();
  for (const Cell& cell : cells) {
    const auto law = static_cast<std::size_t>(std::find(study_laws().begin(), study_laws().end(), cell.variant.law) -
                                              study_laws().begin());
    const int column = cell.variant.integrator ? static_cast<int>(*cell.variant.integrator) : 0;
    svg += box(x_of(law, cell.variant.single, column), y_of(law, static_cast<std::size_t>(cell.number) - 1),
               cell.variant.integrator ? cell_width : columns * cell_width,
               inks[static_cast<std::size_t>(cell.verdict)], cell.promised, cell.short_of_promise, tip_of(cell));
  }
  return svg + "</svg>\n";
}

}  // namespace heml::stability
