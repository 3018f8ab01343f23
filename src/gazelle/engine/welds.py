"""Links held together for a time, as a vacuum gripper holds what it carries."""

from __future__ import annotations

from typing import Any

from gazelle.engine.mjspec_joints import equality_solver
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import weld
from gazelle.engine.state import wake_tree
from gazelle.geometry import Pose

__all__ = ["Welds", "add_weld"]

Pair = tuple[str, str]


def add_weld(spec: Any, pair: Pair, step_s: float) -> None:
    """Add the constraint that can hold two links together; it is idle until commanded."""
    equality = spec.add_equality(
        type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1=pair[0]
    )
    equality.name = weld(*pair)
    equality.name2 = pair[1]
    equality.active = False
    equality_solver(equality, step_s)


class Welds:
    """All pairs of links that can be held together, and at which pose they are held."""

    def __init__(self) -> None:
        self.pairs: list[Pair] = []
        self._held: dict[Pair, Pose] = {}
        self._model: Any = None
        self._data: Any = None

    @property
    def held(self) -> tuple[Pair, ...]:
        """Pairs that are held together now."""
        return tuple(self._held)

    def attach(self, pair: Pair, T_first_second: Pose) -> bool:
        """Hold two links at a pose; returns whether the world must be built first."""
        self._held[pair] = T_first_second
        if pair not in self.pairs:
            self.pairs.append(pair)
            return True
        self._write(pair)
        return False

    def detach(self, pair: Pair) -> None:
        """Let two links go; nothing happens when they are not held."""
        if self._held.pop(pair, None) is not None:
            self._write(pair)

    def release(self) -> None:
        """Let all links go."""
        for pair in self.held:
            self.detach(pair)

    def forget(self, prefix: str) -> None:
        """Drop the pairs of a deleted model."""
        self.pairs = [pair for pair in self.pairs if not _touches(pair, prefix)]
        self._held = {pair: pose for pair, pose in self._held.items() if pair in self.pairs}

    def bind(self, model: Any, data: Any) -> None:
        """Set what is held in a newly compiled world."""
        self.hold(model, data)
        for pair in self._held:
            self._write(pair)

    def hold(self, model: Any, data: Any) -> None:
        """Act on these from now on: the world as it was bound, or a copy of it."""
        self._model, self._data = model, data

    def copy(self) -> Welds:
        """Return a copy for a saved state; it needs `hold` before it acts."""
        other = Welds()
        other.pairs, other._held = list(self.pairs), dict(self._held)
        return other

    def _write(self, pair: Pair) -> None:
        model, data = self._model, self._data
        index = model.equality(weld(*pair)).id
        pose = self._held.get(pair)
        if pose is not None:
            model.eq_data[index, :3] = 0.0
            model.eq_data[index, 3:11] = (*pose.position_m, *pose.quat_wxyz, 1.0)
        data.eq_active[index] = pose is not None
        for link in pair:
            wake_tree(model, data, model.body(link).id)


def _touches(pair: Pair, prefix: str) -> bool:
    return any(link.startswith(prefix) for link in pair)
