#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <heml/base/hash.hpp>

namespace heml::error_test {

TEST_CASE("an input error is one line: file, place, problem and remedy") {
  CHECK(std::string(InputError("a.json", "gravity[1]", "is not a number", "write metres per second squared").what()) ==
        "a.json: gravity[1]: is not a number (write metres per second squared)");
  CHECK(std::string(InputError("a.json", "", "is empty").what()) == "a.json: is empty");
}

TEST_CASE("a hash sees the last bit and the sign of zero, and the order") {
  CHECK(hash_combine(0, 1.0) != hash_combine(0, 1.0000000000000002));
  CHECK(hash_combine(0, 0.0) != hash_combine(0, -0.0));
  CHECK(hash_combine(hash_combine(0, 1.0), 2.0) != hash_combine(hash_combine(0, 2.0), 1.0));
}

}  // namespace heml::error_test
