#include <fmt/format.h>

#include <heml/scenario/text_file.hpp>
#include <studies/html_page.hpp>

namespace heml {
namespace {

constexpr const char* style = R"(
body { max-width: 60rem; margin: 2rem auto; padding: 0 1rem; font: 16px/1.5 system-ui, sans-serif; color: #1c2826; }
h1 { font-size: 1.8rem; } h2 { margin-top: 2.5rem; border-bottom: 1px solid #c9d3d1; }
.answer { font-size: 1.15rem; padding: .8rem 1rem; border-left: 4px solid #2a8578; background: #eef5f3; }
table { border-collapse: collapse; font-size: .85rem; display: block; overflow-x: auto; }
th { text-align: left; border-bottom: 2px solid #8fa09c; } td { border-bottom: 1px solid #e0e6e5; }
th, td { padding: .2rem .6rem; vertical-align: top; } .number { text-align: right; white-space: nowrap; }
figure { margin: 1.5rem 0; } figure img, figure svg { max-width: 100%; height: auto; }
figcaption, summary { color: #55645f; font-size: .9rem; }
pre, code { background: #f1f4f3; font-size: .9em; } pre { padding: .5rem .8rem; overflow-x: auto; }
)";

/// Escaped text, with `code` in <code>.
std::string marked_up(const std::string& text) {
  std::string result;
  bool inside = false;
  for (const char c : html_escaped(text))
    if (c == '`')
      result += (inside = !inside) ? "<code>" : "</code>";
    else
      result += c;
  return inside ? result + "</code>" : result;
}

std::string figure(const std::string& picture, const std::string& caption) {
  return fmt::format("<figure>\n{}\n<figcaption>{}</figcaption></figure>\n", picture, marked_up(caption));
}

}  // namespace

HtmlPage::HtmlPage(const std::string& title) : title_(title) {}

void HtmlPage::heading(const std::string& text) { body_ += fmt::format("<h2>{}</h2>\n", marked_up(text)); }
void HtmlPage::paragraph(const std::string& text) { body_ += fmt::format("<p>{}</p>\n", marked_up(text)); }
void HtmlPage::answer(const std::string& text) { body_ += fmt::format("<p class=answer>{}</p>\n", marked_up(text)); }
void HtmlPage::command(const std::string& text) { body_ += fmt::format("<pre>{}</pre>\n", html_escaped(text)); }
void HtmlPage::table(const TextTable& table) { body_ += html_text(table); }
void HtmlPage::svg(const std::string& picture, const std::string& caption) { body_ += figure(picture, caption); }

void HtmlPage::details(const std::string& summary, const TextTable& table) {
  body_ += fmt::format("<details><summary>{}</summary>\n{}</details>\n", marked_up(summary), html_text(table));
}

void HtmlPage::png(const std::filesystem::path& file, const std::string& caption) {
  body_ += figure(fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", html_escaped(caption),
                              base64(read_text_file(file))),
                  caption);
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!doctype html>\n<html lang=en>\n<head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n<style>{1}</style>"
      "</head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</html>\n",
      html_escaped(title_), style, body_);
}

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u; };
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int k = 0; k < 4; ++k) text += digits[word >> (18 - 6 * k) & 63];
  }
  for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) text[text.size() - 1 - k] = '=';
  return text;
}

}  // namespace heml
