"""heml.gym: Gymnasium's own checks, seeds, batches, and what policies gain."""

import subprocess
import sys
import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import heml.gym  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402

ids = [f"heml/{name}-v0" for name in heml.gym.tasks]


@pytest.mark.parametrize("observation", ["state", "picture"])
@pytest.mark.parametrize("name", ids)
def test_the_checker_is_content(name, observation):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(name, observation=observation).unwrapped)


@pytest.mark.parametrize("name", ids)
def test_scripts_succeed_and_gain_more_than_chance(name):
    env = gymnasium.make(name)
    scripted = heml.gym.evaluate(env, heml.gym.scripted_policy, 5)
    chance = heml.gym.evaluate(env, heml.gym.random_policy, 3)
    assert scripted.successes == 5
    assert chance.successes < 3
    assert scripted.returns.min() > chance.returns.mean()


@pytest.mark.parametrize("name", ids)
def test_a_batch_does_what_lone_worlds_do(name):
    single = gymnasium.make_vec(name, 3, vectorization_mode="sync")
    batch = gymnasium.make_vec(name, 3)
    assert isinstance(batch.unwrapped, heml.gym.TissueVectorEnv)
    assert batch.observation_space == single.observation_space
    assert np.array_equal(single.reset(seed=7)[0], batch.reset(seed=7)[0])
    batch.action_space.seed(1)
    for _ in range(12):
        action = batch.action_space.sample()
        for one, many in zip(single.step(action)[:4], batch.step(action)[:4]):
            assert np.array_equal(one, many)


def test_a_batch_resets_episodes_that_ended():
    batch = gymnasium.make_vec("heml/Reach-v0", 2, max_episode_steps=3)
    batch.reset(seed=0)
    ends = [batch.step(np.zeros((2, 3), np.float32))[3].tolist() for _ in range(5)]
    assert ends == [[False] * 2, [False] * 2, [True] * 2, [False] * 2, [False] * 2]
    before = batch.unwrapped.steps.copy()
    batch.reset(options={"reset_mask": np.array([True, False])})
    assert batch.unwrapped.steps.tolist() == [0, before[1]]


def test_the_cut_parts_the_tissue():
    env = gymnasium.make("heml/CutAlongLine-v0")
    state, _ = env.reset(seed=0)
    world = env.unwrapped.world
    nodes, version = len(world.positions()), world.topology_version
    while True:
        state, _, terminated, truncated, info = env.step(heml.gym.scripted_policy(env, state))
        if terminated or truncated:
            break
    assert info["success"]
    assert len(world.positions()) > nodes
    assert world.topology_version > version


def test_bad_options():
    with pytest.raises(heml.InputError, match="state or picture"):
        gymnasium.make("heml/Reach-v0", observation="smell")
    with pytest.raises(gymnasium.error.ResetNeeded):
        gymnasium.make("heml/Reach-v0").unwrapped.step(np.zeros(3))


def test_missing_gymnasium_names_the_extra():
    code = "import sys; sys.modules['gymnasium'] = None; import heml.gym"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "pip install 'heml[gym]'" in done.stderr
