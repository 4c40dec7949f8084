#include <doctest/doctest.h>

#include <atomic>
#include <heml/session/mailbox.hpp>
#include <thread>

namespace heml::mailbox_test {

TEST_CASE("the reader's slot changes only on request, to the newest frame") {
  Mailbox<int> box;
  CHECK_FALSE(box.waiting());
  for (const int value : {1, 2, 3}) {
    box.back() = value;
    box.publish();
  }
  CHECK(box.waiting());
  const int& seen = box.front();
  CHECK(seen == 3);
  box.back() = 4;
  box.publish();
  box.back() = 5;
  box.publish();
  CHECK(seen == 3);
  CHECK(box.front() == 5);
  CHECK(box.front() == 5);
}

TEST_CASE("a frame is never torn, and frames never go back") {
  struct Pair {
    long a = 0, b = 0;
  };
  Mailbox<Pair> box;
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (long k = 1; !stop; ++k) {
      box.back() = {k, 2 * k};
      box.publish();
    }
  });
  long last = 0;
  for (int i = 0; i < 20000; ++i) {
    const Pair& pair = box.front();
    REQUIRE(pair.b == 2 * pair.a);
    REQUIRE(pair.a >= last);
    last = pair.a;
  }
  stop = true;
  writer.join();
}

}  // namespace heml::mailbox_test
