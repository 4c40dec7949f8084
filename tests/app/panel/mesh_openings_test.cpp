#include <doctest/doctest.h>

#include <app/panel/mesh_openings.hpp>
#include <app/panel/undo_section.hpp>

namespace heml::mesh_openings_test {

using namespace heml::panel;

namespace {

BareMeshOptions of_unit(const char* name, double scale) {
  BareMeshOptions options;
  options.unit = LengthUnit{name, scale};
  return options;
}

const BareMeshOptions guessed, inches = of_unit("inches", 0.0254), metres = of_unit("metres", 1);

MeshOpenings three() {
  MeshOpenings openings;
  for (const BareMeshOptions& options : {guessed, inches, metres}) openings.adopt("a.mesh", options);
  return openings;
}

Frame frame_with(int past, int future) {
  auto list = std::make_shared<UndoList>();
  list->past.assign(static_cast<std::size_t>(past), "grasp");
  list->future.assign(static_cast<std::size_t>(future), "grasp");
  Frame frame;
  frame.undo_list = list;
  return frame;
}

PanelActions stepped(int by, const Frame& frame, const MeshOpenings& openings) {
  PanelActions out;
  step_history(by, frame, openings, out);
  return out;
}

}  // namespace

TEST_CASE("openings of a file come one after another") {
  const MeshOpenings openings = three();
  CHECK_FALSE(openings.at(1));
  REQUIRE(openings.at(-1));
  CHECK(*openings.at(-1) == inches);
  CHECK(*openings.at(-2) == guessed);
  CHECK_FALSE(openings.at(-3));
  CHECK(openings.text(0) == "unit: metres");
  CHECK(openings.text(-2) == "as guessed");
}

TEST_CASE("the file's own number of elements is kept while openings of it do not tell it") {
  MeshOpenings openings;
  openings.adopt("a.obj", guessed, 1200);
  openings.adopt("a.obj", inches);
  CHECK(openings.own_tets() == 1200);
  openings.adopt("a.obj", guessed, 1300);
  CHECK(openings.own_tets() == 1300);
  openings.adopt("b.obj", inches);
  CHECK_FALSE(openings.own_tets());
}

TEST_CASE("an opening that there was becomes the present one, and what came after it waits") {
  MeshOpenings openings = three();
  openings.adopt("a.mesh", inches);
  CHECK(*openings.at(1) == metres);
  CHECK(*openings.at(-1) == guessed);
  openings.adopt("a.mesh", metres);
  CHECK_FALSE(openings.at(1));
  openings.adopt("a.mesh", guessed);
  CHECK(*openings.at(2) == metres);
}

TEST_CASE("a new choice takes the place of what was undone, another file begins anew") {
  MeshOpenings openings = three();
  openings.adopt("a.mesh", guessed);
  BareMeshOptions turned;
  turned.up = UpAxis::x;
  openings.adopt("a.mesh", turned);
  CHECK_FALSE(openings.at(1));
  CHECK(*openings.at(-1) == guessed);
  CHECK_FALSE(openings.at(-2));
  openings.adopt("b.mesh", turned);
  CHECK_FALSE(openings.at(-1));
}

TEST_CASE("what an opening changed is told by its name") {
  BareMeshOptions all = inches;
  all.up = UpAxis::minus_z;
  all.supports = SupportKind::table;
  all.tissue = "liver_human";
  all.tets = 5000;
  CHECK(change_text(guessed, all) == "unit: inches, up: -z, supports: table, tissue: liver_human, tetrahedra: 5000");
  CHECK(change_text(all, inches) == "up: as guessed, supports: as guessed, tissue: as guessed, tetrahedra: as guessed");
  CHECK(change_text(guessed, of_unit("", 0.012)) == "unit: scaled by 0.012");
}

TEST_CASE("undo takes back actions on the body first, then the opening") {
  const MeshOpenings openings = three();
  const PanelActions action = stepped(-1, frame_with(1, 0), openings);
  CHECK_FALSE(action.mesh_options);
  REQUIRE(action.commands.size() == 1);
  CHECK(std::get<StepHistory>(action.commands[0]).by == -1);
  for (const Frame& frame : {Frame(), frame_with(0, 0), frame_with(0, 1)}) {
    const PanelActions opening = stepped(-1, frame, openings);
    CHECK(opening.commands.empty());
    REQUIRE(opening.mesh_options);
    CHECK(*opening.mesh_options == inches);
  }
}

TEST_CASE("redo opens again only where nothing was done and no action waits") {
  MeshOpenings openings = three();
  openings.adopt("a.mesh", inches);
  CHECK(*stepped(1, frame_with(0, 0), openings).mesh_options == metres);
  for (const Frame& frame : {frame_with(1, 0), frame_with(0, 1), frame_with(1, 1)}) {
    CHECK_FALSE(stepped(1, frame, openings).mesh_options);
    CHECK(stepped(1, frame, openings).commands.size() == 1);
  }
}

TEST_CASE("without openings undo and redo are those of the body") {
  for (const int by : {-1, 1}) {
    CHECK_FALSE(stepped(by, Frame(), {}).mesh_options);
    CHECK(stepped(by, Frame(), {}).commands.size() == 1);
  }
}

}  // namespace heml::mesh_openings_test
