"""The tasks: reach, retract, cut."""

from __future__ import annotations

import numpy as np

import heml
from heml.gym.task import Array, Episode, Task, sheet

bonus = 5.0  # at success; every other reward is at most 0, but for marks that are cut


class Reach(Task):
    """A block stuck to a plate is grasped at the middle of its top; that place is to come within 2 mm of a target.

    State: grasped place, tool, target (3 each). Reward: -distance / 2 cm a step, and the bonus at the target.
    """

    scene = sheet(
        [0.06, 0.02, 0.06], [6, 2, 6], 5000, boundary=[{"box": [[-1, -1, -1], [1, 1e-6, 1]], "fix": True}]
    )
    state_size = 9
    near = 0.002

    def __init__(self, world: heml.World) -> None:
        super().__init__(world)
        self.grasped = self.nearest(np.array([0.03, 0.02, 0.03]))

    def begin(self, world: heml.World, random: np.random.Generator) -> Episode:
        place = world.positions()[self.grasped]
        shift = random.uniform([-0.012, 0.002, -0.012], [0.012, 0.012, 0.012])
        world.grasp(node=self.grasped, radius=0.008)
        return Episode(tool=place.copy(), goal=(place + shift)[None])

    def act(self, world: heml.World, episode: Episode, action: Array) -> None:
        episode.tool = np.clip(episode.tool + self.reach * action, [-0.02, 0.0, -0.02], [0.08, 0.08, 0.08])
        world.move(episode.tool)

    def state(self, world: heml.World, episode: Episode) -> Array:
        return np.concatenate([world.positions()[self.grasped], episode.tool, episode.goal[0]])

    def judge(self, world: heml.World, episode: Episode) -> tuple[float, bool]:
        distance = float(np.linalg.norm(world.positions()[self.grasped] - episode.goal[0]))
        reached = distance < self.near
        return -distance / 0.02 + bonus * reached, reached

    def scripted(self, state: Array) -> Array:
        place, _, target = state.reshape(3, 3)
        return np.clip((target - place) / self.reach, -1, 1)


class TissueRetraction(Task):
    """A flap, fixed at one edge, lies on a table over a target disc; its free edge is grasped.

    State: tool, middle of the disc (3 each), nine places of the flap (27), uncovered share of the disc.
    Reward: uncovered share - 1 a step, and the bonus when 95 % can be seen from above.
    """

    scene = sheet(
        [0.08, 0.004, 0.06], [10, 1, 6], 8000,
        boundary=[{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
        tables=[{"point": [0, -0.0005, 0], "normal": [0, 1, 0], "friction": 0.1}],
    )  # fmt: skip
    state_size = 34
    radius = 0.008
    seen = 0.95

    def __init__(self, world: heml.World) -> None:
        super().__init__(world)
        places = [[x, 0.004, z] for x in (0.032, 0.056, 0.08) for z in (0, 0.03, 0.06)]
        self.tracked = [self.nearest(np.array(place)) for place in places]
        self.grasped = self.nearest(np.array([0.08, 0.004, 0.03]))
        turns = np.arange(48) * np.pi * (3 - np.sqrt(5))  # sunflower: equal shares of the disc
        spread = self.radius * np.sqrt((np.arange(48) + 0.5) / 48)
        self.disc = np.stack([spread * np.cos(turns), np.zeros(48), spread * np.sin(turns)], axis=1)

    def begin(self, world: heml.World, random: np.random.Generator) -> Episode:
        place = world.positions()[self.grasped]
        middle = random.uniform([0.042, 0, 0.02], [0.062, 0, 0.04])
        world.grasp(node=self.grasped, radius=0.012)
        return Episode(tool=place.copy(), goal=middle[None])

    def act(self, world: heml.World, episode: Episode, action: Array) -> None:
        episode.tool = np.clip(episode.tool + self.reach * action, [-0.05, 0.002, -0.03], [0.1, 0.08, 0.09])
        world.move(episode.tool)

    def uncovered(self, world: heml.World, episode: Episode) -> float:
        """Share of the disc that no triangle of the surface hides from above."""
        corners = world.positions()[self.surface][:, :, [0, 2]]
        points = (episode.goal[0] + self.disc)[:, None, [0, 2]]
        sides = [cross(corners[:, (k + 1) % 3] - corners[:, k], points - corners[:, k]) for k in range(3)]
        inside = np.all(np.array(sides) > 0, axis=0) | np.all(np.array(sides) < 0, axis=0)
        return 1 - float(np.mean(inside.any(axis=1)))

    def state(self, world: heml.World, episode: Episode) -> Array:
        places = world.positions()[self.tracked].ravel()
        return np.concatenate([episode.tool, episode.goal[0], places, [self.uncovered(world, episode)]])

    def judge(self, world: heml.World, episode: Episode) -> tuple[float, bool]:
        share = self.uncovered(world, episode)
        return share - 1 + bonus * (share >= self.seen), share >= self.seen

    def scripted(self, state: Array) -> Array:
        """Up, then over towards the fixed edge."""
        tool = state[:3]
        over = np.array([-0.01 - tool[0], 0.045 - tool[1], 0.03 - tool[2]])
        lift = np.array([0.06 - tool[0], 0.05 - tool[1], 0.0])
        return np.clip((lift if tool[1] < 0.035 else over) / self.reach, -1, 1)


class CutAlongLine(Task):
    """A sheet, clamped and drawn apart at two edges, is cut through along 15 marks on it.

    The blade stands upright; actions move it in the plane of the sheet (the second number has no effect).
    State: blade, next mark, the mark after it (3 each), number of marks that are left.
    Reward a step: marks that the blade has come within 2 mm of, in their order; -0.1; -0.1 for each mm beside the
    line; and the bonus at the last mark.
    """

    scene = sheet(
        [0.08, 0.004, 0.05], [12, 1, 8], 10000,
        boundary=[
            {"box": [[-1, -1, -1], [1, 1, 1e-6]], "translate": [0, 0, -0.002]},
            {"box": [[-1, -1, 0.05 - 1e-6], [1, 1, 1]], "translate": [0, 0, 0.002]},
        ],
        gravity=[0, 0, 0],
    )  # fmt: skip
    view = {"azimuth": 0, "elevation": 60}
    state_size = 10
    marks = 15
    near = 0.002

    def begin(self, world: heml.World, random: np.random.Generator) -> Episode:
        start, end = random.uniform([[0.008, 0.018], [0.06, 0.018]], [[0.014, 0.032], [0.068, 0.032]])
        line = start + np.linspace(0, 1, self.marks)[:, None] * (end - start)
        nodes, weights = zip(*(self._hold(place) for place in line))
        episode = Episode(tool=np.zeros(3), goal=np.zeros((self.marks, 3)))
        episode.nodes, episode.weights = np.array(nodes), np.array(weights)
        episode.goal = self._marks(world, episode)
        episode.tool = episode.goal[0] + np.array([-0.004, 0, 0])
        return episode

    def _hold(self, place: Array) -> tuple[Array, Array]:
        """The top triangle below a place (x, z) at rest: its nodes (3,), and the weights (3,) of the place."""
        corners = self.rest[self.surface]
        for nodes in self.surface[np.all(corners[:, :, 1] > 0.003, axis=1)]:
            a, b, c = self.rest[nodes][:, [0, 2]]
            u, v = np.linalg.solve(np.stack([b - a, c - a], axis=1), place - a)
            if min(u, v, 1 - u - v) >= -1e-9:
                return nodes, np.array([1 - u - v, u, v])
        raise ValueError(f"no surface at {place}")

    def _marks(self, world: heml.World, episode: Episode) -> Array:
        """Where the marks are now (k, 3): they move with the tissue."""
        return np.einsum("kn,kni->ki", episode.weights, world.positions()[episode.nodes])

    def act(self, world: heml.World, episode: Episode, action: Array) -> None:
        step = self.reach * np.asarray(action) * [1, 0, 1]
        target = np.clip(episode.tool + step, [-0.005, -1, -0.005], [0.085, 1, 0.055])
        if np.linalg.norm(target - episode.tool) > 1e-4:
            up = np.array([0, 0.01, 0])
            sweep = [[(place + up).tolist(), (place - up).tolist()] for place in (episode.tool, target)]
            world.apply({"cut": {"sweep": sweep, "goes_on": episode.started}})
            episode.started = True
        episode.tool = target

    def state(self, world: heml.World, episode: Episode) -> Array:
        marks = self._marks(world, episode)
        following = [marks[min(episode.progress + ahead, self.marks - 1)] for ahead in (0, 1)]
        return np.concatenate([episode.tool, *following, [(self.marks - episode.progress) / self.marks]])

    def judge(self, world: heml.World, episode: Episode) -> tuple[float, bool]:
        marks = self._marks(world, episode)[:, [0, 2]]
        blade, before = episode.tool[[0, 2]], episode.progress
        while episode.progress < self.marks and np.linalg.norm(marks[episode.progress] - blade) < self.near:
            episode.progress += 1
        done = episode.progress == self.marks
        beside = abs(cross(marks[-1] - marks[0], blade - marks[0])) / np.linalg.norm(marks[-1] - marks[0])
        reward = episode.progress - before - 0.1 - 100 * float(beside) + bonus * done
        return reward, done

    def scripted(self, state: Array) -> Array:
        return np.clip((state[3:6] - state[:3]) / self.reach, -1, 1)


def cross(a: Array, b: Array) -> Array:
    """z of the product of plane vectors (..., 2)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


tasks: dict[str, type[Task]] = {"Reach": Reach, "TissueRetraction": TissueRetraction, "CutAlongLine": CutAlongLine}
"""By the name between `heml/` and `-v0`."""
