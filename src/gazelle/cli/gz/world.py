"""``gz world``: pausing, stepping and resetting."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number
from gazelle.cli.gz.world_link import world_link

__all__ = ["COMMAND", "run"]

COMMAND = GzCommand(
    "world",
    "Change properties of a Gazebo world on a running\n\tserver. If a name for the world, option "
    "-w, is not specified,\n\tthe first world found on the Gazebo master will be used.",
    (
        GzOption("world-name", "w", "World name; Gazelle has one world.", takes=True),
        GzOption("pause", "p", "Pause/unpause simulation. 0=unpause, 1=pause.", takes=True),
        GzOption("step", "s", "Step simulation one iteration."),
        GzOption("multi-step", "m", "Step simulation mulitple iteration.", takes=True),
        GzOption("reset-all", "r", "Reset time and model poses."),
        GzOption("reset-time", "t", "Reset time."),
        GzOption("reset-models", "o", "Reset models."),
    ),
)


def run(options: Mapping[str, str]) -> int:
    """Do what the options say to the world.

    Raises:
        GzError: an option is wrong, or there is no world.
    """
    if "reset-time" in options:
        raise GzError("time alone is not reset here; use -r (time and models) or -o (models)")
    if not set(options) - {"world-name"}:
        raise GzError("nothing to do; see gz help world")
    steps = _steps(options)
    pause = options.get("pause")
    if pause not in (None, "0", "1"):
        raise GzError(f"--pause is 0 or 1, not '{pause}'")
    with world_link() as link:
        if "reset-all" in options:
            link.call("reset_simulation", "std_srvs/Empty")
        elif "reset-models" in options:
            link.call("reset_world", "std_srvs/Empty")
        if steps:
            # Gazebo's world is paused after a step too.
            link.control(pause=True, steps=steps)
        if pause is not None:
            link.control(pause=pause == "1")
    return 0


def _steps(options: Mapping[str, str]) -> int:
    if "step" in options:
        return 1
    steps = number(options, "multi-step")
    if "multi-step" in options and (steps < 1 or steps != int(steps)):
        word = options["multi-step"]
        raise GzError(f"--multi-step is a whole number above 0, not '{word}'")
    return int(steps)
