"""Time of the world: playing, pausing, stepping, resetting."""

from __future__ import annotations

from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.interfaces import message_type
from gazelle.studio.errors import StudioError
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.world.link import ask_world, call_world

__all__ = ["pause", "play", "reset", "set_factor", "step"]

_RESETS = {"world": "reset_world", "poses": "reset_world", "time": "reset_simulation"}


def pause(studio: Studio, _params: Params) -> Any:
    """``world.pause``."""
    call_world(studio, "pause_physics", "std_srvs/Empty")
    return {}


def play(studio: Studio, _params: Params) -> Any:
    """``world.play``."""
    call_world(studio, "unpause_physics", "std_srvs/Empty")
    return {}


def step(studio: Studio, params: Params) -> Any:
    """``world.step``: pauses, and takes so many steps."""
    count = params.whole("count", 1, least=1, most=1_000_000)
    control = message_type("ros_gz_interfaces/WorldControl")(pause=True, multi_step=count)
    kind = "ros_gz_interfaces/ControlWorld"
    call_world(studio, "control_world", kind, world_control=control)
    return {}


def reset(studio: Studio, params: Params) -> Any:
    """``world.reset``: poses alone, or time as well."""
    what = params.text("what", "world")
    if what not in _RESETS:
        raise StudioError(f"world.reset: there is no '{what}'", known=nearest_names(what, _RESETS))
    call_world(studio, _RESETS[what], "std_srvs/Empty")
    return {}


def set_factor(studio: Studio, params: Params) -> Any:
    """``world.factor``: the wanted real-time factor, 0 for as fast as possible."""
    return ask_world(studio, op="factor", wanted_rtf=params.number("wanted_rtf", least=0.0))
