#include <doctest/doctest.h>

#include <heml/mesh/xml.hpp>
#include <heml/mesh/xml_values.hpp>
#include <messages.hpp>

#include "engine/mesh/files.hpp"

namespace heml::xml_test {

namespace {

std::string refusal_of(const std::string& text) {
  return refusal([&] { XmlDocument("a.xml", text); });
}

}  // namespace

TEST_CASE("elements have their attributes, text and children in order") {
  const std::string text = R"(<?xml version="1.0"?>
<!-- a comment with <tags> -->
<a k = 'v > "w"' other="&lt;&#228;&#x41;&amp;&nothing;">
  <b>1, <!-- in between -->2<![CDATA[ < 3]]></b>
  <c/>
  <b k=""/>
</a>
)";
  const XmlDocument document("a.xml", text);
  const XmlElement a = document.root();
  CHECK(a.name() == "a");
  CHECK(a.text().empty());
  CHECK(a.attribute("k") == "v > \"w\"");
  CHECK(a.attribute("other") ==
        "<\xc3\xa4"
        "A&&nothing;");
  CHECK_FALSE(a.attribute("v"));
  std::vector<std::string> names;
  for (const XmlElement child : a.children()) names.emplace_back(child.name());
  CHECK(names == std::vector<std::string>{"b", "c", "b"});
  CHECK(a.child("b")->text() == "1, 2 < 3");
  CHECK(a.child("c")->text().empty());
  CHECK(a.child("c")->line() == 5);
  CHECK_FALSE(a.child("d"));
  CHECK(a.child("b")->attribute_or_empty("k").empty());
}

TEST_CASE("a text that is no XML, damaged or hostile has one message with its line") {
  CHECK(says(refusal_of(""), "holds no XML element"));
  CHECK(says(refusal_of("once upon a time"), "line 1: is no XML"));
  CHECK(says(refusal_of("<a>\n<b>1</b>\n"), "line 3: ends within <a>"));
  CHECK(says(refusal_of("<a>\n<b>1</c>\n</a>"), "line 2: '</c' where </b> should be, which began in line 2"));
  CHECK(says(refusal_of("<a>\n<b k=\"1></b></a>"), "line 2: a tag does not end"));
  CHECK(says(refusal_of("<a>\n<b <c/></a>"), "line 2: a tag does not end before the next begins"));
  CHECK(says(refusal_of("<a/>\n<b/>"), "line 2: a second element"));
  CHECK(says(refusal_of("<a/>\nrest"), "text behind the last element"));
  CHECK(says(refusal_of("</a>"), "ends what did not begin"));
  CHECK(says(refusal_of("<a><!-- "), "a comment does not end"));
  CHECK(says(refusal_of("<a>< /a>"), "a tag without a name"));
  CHECK(says(refusal_of("<!DOCTYPE a [<!ENTITY b \"bb\">]><a>&b;</a>"), "a DOCTYPE or an entity"));
  CHECK(says(refusal_of("\xff\xfe<"), "is in UTF-16"));
  std::string deep;
  for (int k = 0; k < 100'000; ++k) deep += "<a>";
  CHECK(says(refusal_of(deep), "nested more than 64 deep"));
  const std::string loose = "<a k=v/>", missing = "<a k/>";
  CHECK(says(refusal([&] { XmlDocument("a.xml", loose).root().attribute("k"); }), "is not in quotes"));
  CHECK(says(refusal([&] { XmlDocument("a.xml", missing).root().attribute("k"); }), "an attribute without a value"));
}

TEST_CASE("values are numbers between commas or blanks") {
  const std::string text = "<a><b> 1, +2.5 ,-3e2</b><c>4\n5 6</c><d>1,x</d><e>1e999</e><f>1.5</f></a>";
  const XmlDocument document("a.xml", text);
  const XmlElement a = document.root();
  CHECK(numbers_in(*a.child("b"), "a place") == std::vector<double>{1, 2.5, -300});
  CHECK(integers_in(*a.child("c"), "numbers", 3) == std::vector<int>{4, 5, 6});
  CHECK(says(refusal([&] { integers_in(*a.child("c"), "the nodes", 4); }),
              "the nodes should be 4 numbers, 3 are there"));
  CHECK(says(refusal([&] { numbers_in(*a.child("d"), "a place"); }), "a place should be a number, is 'x'"));
  CHECK(says(refusal([&] { numbers_in(*a.child("e"), "a place"); }), "a place should be a number, is '1e999'"));
  CHECK(says(refusal([&] { integers_in(*a.child("f"), "an id"); }), "an id should be a whole number, is '1.5'"));
}

}  // namespace heml::xml_test
