#include <doctest/doctest.h>

#include <heml/base/shared.hpp>
#include <optional>
#include <thread>
#include <vector>

namespace heml::shared_test {

TEST_CASE("copies share a value until one of them is written to") {
  Shared<std::vector<int>> a = std::vector<int>{1, 2, 3};
  Shared<std::vector<int>> b = a;
  CHECK(a.shares_with(b));
  CHECK(a->data() == b->data());
  b.write().push_back(4);
  CHECK(!a.shares_with(b));
  CHECK(*a == std::vector<int>{1, 2, 3});
  CHECK(*b == std::vector<int>{1, 2, 3, 4});
}

TEST_CASE("a value of one alone is written to in its place") {
  Shared<std::vector<int>> a = std::vector<int>{1, 2, 3};
  const std::vector<int>* place = &*a;
  a.write()[0] = 5;
  CHECK(&*a == place);
  { const Shared<std::vector<int>> b = a; }  // NOLINT: another, for a while
  a.write()[0] = 6;
  CHECK(&*a == place);
  const Shared<std::vector<int>> moved = std::move(a);
  CHECK(&*moved == place);
  CHECK(moved->front() == 6);
}

TEST_CASE("a value that its first holder has left stays with the others") {
  Shared<std::vector<int>> a = std::vector<int>{1};
  Shared<std::vector<int>> b = a;
  a = std::vector<int>{2};
  CHECK(b->front() == 1);
  b.write().front() = 3;
  CHECK(a->front() == 2);
}

// A race is seen by the thread sanitizer.
TEST_CASE("a value is written to after who shared it has read it") {
  for (int k = 0; k < 200; ++k) {
    Shared<std::vector<int>> a = std::vector<int>(1000, 1);
    int sum = 0;
    std::thread reader([&sum, b = std::optional(a)]() mutable {
      for (const int value : **b) sum += value;
      b.reset();
    });
    for (int n = 0; n < 1000; ++n) a.write()[0] = 2;
    reader.join();
    CHECK(sum == 1000);
    CHECK(a->front() == 2);
  }
}

}  // namespace heml::shared_test
