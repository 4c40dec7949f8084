#include <doctest/doctest.h>

#include <app/panel/search.hpp>

namespace heml::search_test {

using panel::has_words;

TEST_CASE("a search finds texts that have all of its words, as parts and in any case") {
  CHECK(has_words("Young's E: stiffness of the tissue", "young"));
  CHECK(has_words("Young's E: stiffness of the tissue", "TISS  stiff"));
  CHECK_FALSE(has_words("Young's E: stiffness of the tissue", "young water"));
  CHECK_FALSE(has_words("", "a"));
}

TEST_CASE("a search of no words finds everything") {
  CHECK(has_words("anything", ""));
  CHECK(has_words("", " \t"));
}

}  // namespace heml::search_test
