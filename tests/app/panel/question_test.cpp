#include "driver.hpp"

namespace heml::question_test {

using namespace heml::test;
using panel::Action;

namespace {

struct Asked : Driver {
  Asked() { panel.ask("Save?", "Nothing holds it.", {"Save", "Discard", "Cancel"}); }
  std::optional<std::size_t> press(Action action) {
    panel.perform(action);
    const auto first = draw().answer;
    return first ? first : draw().answer;
  }
};

}  // namespace

TEST_CASE("a question is answered by keys") {
  CHECK(Asked().press(Action::open_selected) == 0u);
  CHECK(Asked().press(Action::release) == 2u);
  Asked second;
  CHECK_FALSE(second.press(Action::seek_next));
  CHECK(second.press(Action::open_selected) == 1u);
  Asked last;
  CHECK_FALSE(last.press(Action::seek_previous));
  CHECK(last.press(Action::open_selected) == 2u);
}

TEST_CASE("a question takes the mouse and all keys until it is answered") {
  Asked driver;
  driver.draw();
  CHECK(driver.panel.covers(640, 700));
  CHECK_FALSE(driver.press(Action::reset));
  CHECK(driver.draw().commands.empty());
  CHECK(driver.press(Action::release) == 2u);
  CHECK_FALSE(driver.panel.is_modal());
  CHECK_FALSE(driver.panel.covers(640, 360));
  CHECK_FALSE(driver.draw().answer);
}

}  // namespace heml::question_test
