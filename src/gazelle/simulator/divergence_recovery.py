"""A world whose state is no longer finite goes back to the last step that was, and says why."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING

from gazelle.errors import SimulationDivergedError

if TYPE_CHECKING:
    from gazelle.engine import Engine
    from gazelle.simulator.world_server import WorldServer

__all__ = ["DIVERGENCE", "OnDivergence", "Recovery"]

DIVERGENCE = "on_divergence"
"""Of the node ``gazebo``: an `OnDivergence`."""

_NS = 1e-9
# Of simulated time; what diverges so soon again was not mended.
_SOON_NS = 1_000_000_000
_SHOWN_EFFORTS = 4


class OnDivergence(enum.StrEnum):
    """What becomes of a running world when a model diverges."""

    PAUSE = "pause"
    REMOVE = "remove"


class Recovery:
    """Lets a world go on after its engine went back to the last finite state."""

    def __init__(self, server: WorldServer) -> None:
        """Begin; nothing has diverged yet."""
        self._server = server
        self._last = ("", 0)

    def recover(self, error: SimulationDivergedError) -> None:
        """Let the world go on.

        The model at fault comes to rest, and what acted on it ends: otherwise the next step would
        end as this one did. By `DIVERGENCE` it is taken out of the world instead, which then goes
        on.

        Args:
            error: what the engine said.
        """
        server = self._server
        engine = server.engine
        model = error.link.partition("::")[0]
        is_known = engine.world.model(model) is not None
        lines = [str(error), *_acting(engine, model), *_sent(server)]
        if is_known and server.on_divergence() is OnDivergence.REMOVE:
            server.delete(model)
            lines.append(
                f"'{model}' is taken out of the world, which goes on ({DIVERGENCE}: remove)"
            )
        else:
            if is_known:
                _calm(server, model)
            server.pause()
            lines.append(self._paused(model))
        server.node.log("ERROR", "\n  ".join(lines))

    def _paused(self, model: str) -> str:
        time_ns = self._server.engine.time_ns
        text = f"the world is back at {time_ns * _NS:.3f} s and paused; '{model}' is at rest"
        (before, at_ns), self._last = self._last, (model, time_ns)
        if before == model and 0 <= time_ns - at_ns < _SOON_NS:
            return (
                f"{text}, as it was before: something drives it on, or it cannot be where it is\n"
                "  fix: stop what drives it, put it elsewhere, delete it or reset the world, then "
                "unpause"
            )
        return (
            f"{text} and free of efforts and wrenches\n  fix: mend what is named here, then unpause"
        )


def _acting(engine: Engine, model: str) -> list[str]:
    found = []
    for name in engine.joint_names:
        if name.startswith(f"{model}::"):
            joint = engine.joint(name)
            if joint.is_driveable and joint.effort:
                found.append(f"{joint.effort:g} at '{name.partition('::')[2]}'")
    if not found:
        return []
    more = f" and {len(found) - _SHOWN_EFFORTS} more" if len(found) > _SHOWN_EFFORTS else ""
    return [f"efforts at work: {', '.join(found[:_SHOWN_EFFORTS])}{more}"]


def _sent(server: WorldServer) -> list[str]:
    arrivals = server.inputs.recent(server.time_ns)
    if not arrivals:
        return []
    senders = [
        f"{one.name} (by {', '.join(names)})" if (names := server.senders(one)) else one.name
        for one in arrivals
    ]
    return [f"last commands: {', '.join(senders)}"]


def _calm(server: WorldServer, model: str) -> None:
    engine = server.engine
    for name in engine.joint_names:
        if name.startswith(f"{model}::"):
            joint = engine.joint(name)
            if joint.is_driveable:
                joint.release()
    for name in engine.link_names:
        if name.startswith(f"{model}::"):
            engine.link(name).clear_wrenches()
    engine.bring_to_rest(model)
    server.calm(model)
