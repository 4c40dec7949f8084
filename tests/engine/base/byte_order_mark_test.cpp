#include <doctest/doctest.h>

#include <heml/base/byte_order_mark.hpp>

namespace heml::byte_order_mark_test {

TEST_CASE("a byte order mark is three bytes at the very beginning of a text, once") {
  CHECK(byte_order_mark_size("\xEF\xBB\xBFnode,x") == 3);
  CHECK(byte_order_mark_size("\xEF\xBB\xBF\xEF\xBB\xBF") == 3);
  CHECK(byte_order_mark_size("\xEF\xBB\xBF") == 3);
  for (const char* text : {"", "node,x", "\xEF\xBB", " \xEF\xBB\xBF", "\xFF\xFE"})
    CHECK(byte_order_mark_size(text) == 0);
}

}  // namespace heml::byte_order_mark_test
