"""Which joints of a world viewers see moving, in one order for all."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["moving_joints"]


def moving_joints(engine: Engine) -> tuple[str, ...]:
    """Return the joints with one position each, ``model::joint``, as the scene value has them."""
    return tuple(name for name in engine.joint_names if engine.joint(name).is_driveable)
