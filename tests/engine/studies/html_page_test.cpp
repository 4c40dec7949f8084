#include <doctest/doctest.h>

#include <cmath>
#include <heml/base/write_file.hpp>
#include <places.hpp>
#include <studies/html_page.hpp>

namespace heml::html_page_test {

TEST_CASE("base64 as RFC 4648 has it") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xff\xfe\x00z"
               "") == "//4=");
}

TEST_CASE("a page holds its text escaped, its tables and its pictures") {
  const auto picture = test::build_folder() / "page_picture.png";
  write_file(picture, "foobar");
  HtmlPage page("A & B");
  page.heading("J < 0");
  page.paragraph("run `heml --help` <now>");
  page.table({{"law", "figure"}, {{"stvk", "1"}}, 1, 2});
  page.png(picture, "what is seen");
  const std::string text = page.text();
  for (const char* part : {"<title>A &amp; B</title>", "<h2>J &lt; 0</h2>", "run <code>heml --help</code> &lt;now&gt;",
                           "<td>stvk</td><td class=number>1</td>", "data:image/png;base64,Zm9vYmFy", "</html>"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part);
}

TEST_CASE("tables as Markdown and as CSV") {
  const TextTable table{{"law", "figure"}, {{"µ, λ", "1"}, {"a \"b\"", "22"}}, 1, 2};
  CHECK(markdown_text(table) == "| law   | figure |\n|-------|-------:|\n| µ, λ  |      1 |\n| a \"b\" |     22 |\n");
  CHECK(csv_text(table) == "law,figure\n\"µ, λ\",1\n\"a \"\"b\"\"\",22\n");
  CHECK(short_number(0.00001234) == "1.23e-05");
  CHECK(short_number(12.3456) == "12.35");
  CHECK(short_number(NAN) == "not a number");
}

}  // namespace heml::html_page_test
