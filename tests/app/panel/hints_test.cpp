#include <doctest/doctest.h>

#include <algorithm>
#include <app/panel/hints.hpp>

namespace heml::hints_test {

using namespace heml::panel;

namespace {
bool says(const Situation& situation, const std::string& words) {
  const std::vector<std::string> hints = hints_for(situation);
  return std::any_of(hints.begin(), hints.end(),
                     [&](const std::string& hint) { return hint.find(words) != std::string::npos; });
}
}  // namespace

TEST_CASE("the hints follow the tool and what the mouse does") {
  Situation now;
  CHECK(hints_for(now).front() == "drag the tissue to pull it");
  CHECK(says(now, "C to cut"));
  now.interaction = Interaction::grasping;
  CHECK(says(now, "let go"));
  CHECK(says(now, "L leaves a clamp"));
  now.interaction = Interaction::aiming;
  CHECK(says(now, "Shift: along an axis"));
  now = {};
  now.tool = Tool::scalpel;
  CHECK(says(now, "G to grasp"));
  now.interaction = Interaction::cutting;
  CHECK(says(now, "Esc leaves"));
  CHECK_FALSE(says(now, "hidden"));
  now.hides = true;
  CHECK(says(now, "hidden tissue is cut too"));
  now.interaction = Interaction::none;
  CHECK(says(now, "hidden tissue is cut too"));
  now.tool = Tool::grasper;
  CHECK_FALSE(says(now, "hidden"));
  now = {};
  now.tool = Tool::scissors;
  CHECK(says(now, "click to snip"));
  now.interaction = Interaction::snipping;
  CHECK(says(now, "snip on"));
  now = {};
  now.tool = Tool::cautery;
  CHECK(says(now, "burn it"));
  CHECK(says(now, "takes a burn back"));
  now.hides = true;
  CHECK(says(now, "hidden tissue is burnt too"));
  now.interaction = Interaction::burning;
  CHECK(says(now, "Esc leaves"));
  now = {};
  now.tool = Tool::suture;
  CHECK(says(now, "one end"));
  now.suture_begun = true;
  CHECK(says(now, "the other end"));
}

TEST_CASE("what the controls of a new device do comes first, and a pause before it") {
  Situation now;
  now.device = {"Gamepad: left stick moves", "A grasps"};
  CHECK(hints_for(now)[0] == "Gamepad: left stick moves");
  CHECK(hints_for(now)[1] == "A grasps");
  CHECK(says(now, "drag the tissue"));
  now.paused = true;
  CHECK(hints_for(now)[0] == "paused: Space runs");
  now.paused = false;
  now.interaction = Interaction::grasping;
  CHECK_FALSE(says(now, "A grasps"));
}

TEST_CASE("a pause, a past frame and a stopped body have hints of their own") {
  Situation now;
  now.paused = true;
  CHECK(hints_for(now).front() == "paused: Space runs");
  now.past = true;
  CHECK(says(now, "B goes on from here"));
  now.halted = true;
  CHECK(says(now, "R starts again"));
  CHECK_FALSE(says(now, "drag the tissue"));
}

TEST_CASE("every tool and every interaction has hints") {
  for (int tool = 0; tool <= static_cast<int>(Tool::remover); ++tool)
    for (int doing = 0; doing <= static_cast<int>(Interaction::panning); ++doing)
      CHECK_FALSE(hints_for({static_cast<Tool>(tool), static_cast<Interaction>(doing)}).empty());
}

}  // namespace heml::hints_test
