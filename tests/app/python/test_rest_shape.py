"""Rest positions and regions of a world, before and after edits."""
import numpy as np
import pytest

import heml


def test_rest_positions_are_those_without_load_and_follow_edits(box, sweep):
    placed = box()
    placed["mesh"]["translate"] = [0.5, 0, 0]
    placed["boundary"][0]["box"] = [[-1, -1, -1], [0.5 + 1e-6, 1, 1]]
    world = heml.World(placed, threads=1)
    at_start = world.positions()
    world.step(50)
    assert np.array_equal(world.rest_positions(), at_start) and not np.array_equal(world.positions(), at_start)
    assert at_start[:, 0].min() == 0.5
    state = world.snapshot()
    world.cut(np.array(sweep) + [0.5, 0, 0])
    rest = world.rest_positions()
    assert rest.shape == world.positions().shape and len(rest) > 45
    assert np.array_equal(rest[:45], at_start)
    corners = rest[world.tets]
    assert np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6 == pytest.approx(0.1 * 0.04 * 0.04)
    out = np.empty_like(rest)
    assert world.rest_positions(out=out) is out and np.array_equal(out, rest)
    world.apply({"history": -1})
    assert np.array_equal(world.rest_positions(), at_start)
    world.apply({"history": 1})
    assert np.array_equal(world.rest_positions(), rest)
    world.restore(state)
    assert np.array_equal(world.rest_positions(), at_start)


def write_halves(path, whole):
    """A mesh file of a world at rest: region 2 where x > 0.05, else 7. Returns the regions."""
    nodes, tets = whole.rest_positions(), whole.tets
    regions = np.where(nodes[tets].mean(1)[:, 0] > 0.05, 2, 7)
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", len(nodes)]
    lines += [f"{x!r} {y!r} {z!r} 0" for x, y, z in nodes.tolist()]
    lines += ["Tetrahedra", len(tets)]
    lines += [f"{a + 1} {b + 1} {c + 1} {d + 1} {r}" for (a, b, c, d), r in zip(tets.tolist(), regions)]
    path.write_text("\n".join(map(str, [*lines, "End", ""])))
    return regions


def test_regions_are_those_of_the_file_and_follow_edits(box, sweep, tmp_path):
    assert np.array_equal(heml.World(box(), threads=1).regions(), np.zeros(80))
    given = write_halves(tmp_path / "halves.mesh", heml.World(box(), threads=1))
    world = heml.World(box(mesh={"file": str(tmp_path / "halves.mesh")}), threads=1)
    assert world.regions().dtype == np.int32 and np.array_equal(world.regions(), given)
    assert world.region_names() == {}
    world.cut(sweep)
    regions = world.regions()
    assert len(regions) == len(world.tets) > 80
    beyond = world.rest_positions()[world.tets].mean(1)[:, 0] > 0.05
    assert np.array_equal(regions == 2, beyond)
    world.apply({"remove": {"region": 2}})
    assert np.array_equal(world.regions(), np.full(len(world.tets), 7)) and len(world.tets) == (~beyond).sum()
    world.apply({"history": -1})
    assert np.array_equal(world.regions(), regions)
    world.undo()
    assert np.array_equal(world.regions(), given)


def test_regions_of_a_label_map_have_its_names(box, tmp_path):
    side = 12
    voxels = [0 if 0 in (i, j, k) or side - 1 in (i, j, k) else 3 if i < side // 2 else 5
              for k in range(side) for j in range(side) for i in range(side)]
    (tmp_path / "scan.nrrd").write_text(
        f"NRRD0004\ntype: short\ndimension: 3\nspace: right-anterior-superior\nsizes: {side} {side} {side}\n"
        "space directions: (5,0,0) (0,5,0) (0,0,5)\nspace origin: (0,0,0)\nendian: little\nencoding: ascii\n"
        "Segment0_Name:=liver\nSegment0_LabelValue:=3\nSegment1_Name:=portal vein\nSegment1_LabelValue:=5\n\n"
        + " ".join(map(str, voxels)))
    scene = box(mesh={"labels": str(tmp_path / "scan.nrrd"), "tets": 500}, boundary=[])
    world = heml.World(scene, threads=1)
    assert world.region_names() == {3: "liver", 5: "portal vein"}
    left = world.rest_positions()[world.tets].mean(1)[:, 0] < 0.0275
    assert set(world.regions()) == {3, 5} and np.mean((world.regions() == 3) == left) > 0.95
