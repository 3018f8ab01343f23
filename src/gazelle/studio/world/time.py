"""Time of the world: playing, pausing, stepping, resetting."""

from __future__ import annotations

from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.interfaces import message_type
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.world.world_control import WorldLink

__all__ = ["pause", "play", "reset", "set_factor", "step"]

_RESETS = {"world": "reset_world", "poses": "reset_world", "time": "reset_simulation"}


def pause(world: WorldLink, _params: Params) -> Any:
    """``world.pause``."""
    world.call("pause_physics", "std_srvs/Empty")
    return {}


def play(world: WorldLink, _params: Params) -> Any:
    """``world.play``."""
    world.call("unpause_physics", "std_srvs/Empty")
    return {}


def step(world: WorldLink, params: Params) -> Any:
    """``world.step``: pauses, and takes so many steps."""
    count = params.whole("count", 1, least=1, most=1_000_000)
    control = message_type("ros_gz_interfaces/WorldControl")(pause=True, multi_step=count)
    kind = "ros_gz_interfaces/ControlWorld"
    world.call("control_world", kind, world_control=control)
    return {}


def reset(world: WorldLink, params: Params) -> Any:
    """``world.reset``: poses alone, or time as well."""
    what = params.text("what", "world")
    if what not in _RESETS:
        raise StudioError(f"world.reset: there is no '{what}'", known=nearest_names(what, _RESETS))
    world.call(_RESETS[what], "std_srvs/Empty")
    return {}


def set_factor(world: WorldLink, params: Params) -> Any:
    """``world.factor``: the wanted real-time factor, 0 for as fast as possible."""
    return world.ask(op="factor", wanted_rtf=params.number("wanted_rtf", least=0.0))
