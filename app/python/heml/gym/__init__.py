"""Gymnasium environments of soft tissue (extra `gym`). `import heml.gym` registers them:

    heml/Reach-v0              brings a grasped place of a tissue block to a target
    heml/TissueRetraction-v0   pulls a flap aside until a target below it can be seen from above
    heml/CutAlongLine-v0       cuts a clamped sheet along marks on it

Options of `gymnasium.make`: `observation="state"` or `"picture"`, `size` of pictures (width, height), `threads`.
`gymnasium.make_vec(id, n)` steps n of them on one `heml.Batch`. Lengths are in metres. `python -m heml.gym` prints the
returns of a random and of a scripted policy.
"""

from __future__ import annotations

from heml._optional import require

gymnasium = require("gymnasium", "gym")

from heml.gym.environment import TissueEnv  # noqa: E402
from heml.gym.policies import Policy, evaluate, random_policy, scripted_policy  # noqa: E402
from heml.gym.task import Task  # noqa: E402
from heml.gym.tasks import tasks  # noqa: E402
from heml.gym.vector import TissueVectorEnv  # noqa: E402

__all__ = [
    "Policy", "Task", "TissueEnv", "TissueVectorEnv", "evaluate", "random_policy", "register", "scripted_policy", "tasks",
]  # fmt: skip


def register() -> None:
    """Registers the environments that are not registered yet."""
    for name, task in tasks.items():
        if f"heml/{name}-v0" not in gymnasium.registry:
            gymnasium.register(
                f"heml/{name}-v0",
                entry_point="heml.gym.environment:TissueEnv",
                vector_entry_point="heml.gym.vector:TissueVectorEnv",
                kwargs={"task": name},
                max_episode_steps=task.max_steps,
            )


register()
