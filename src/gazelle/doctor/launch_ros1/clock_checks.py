"""Checks of time: who owns ``/clock``, and do the nodes follow it."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import SequenceMatcher

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role

__all__ = ["check_clock"]

_NAME = "/use_sim_time"
_WORD = "use_sim_time"
_MIN_LIKENESS = 0.76


def check_clock(
    launched: Launched, starts: Mapping[str, DryStart], diagnostics: Diagnostics
) -> None:
    """Report clocks that contradict each other.

    Args:
        launched: the launch.
        starts: simulators that came up.
        diagnostics: receives the findings.
    """
    owners = [node for node in launched.nodes if _owns_clock(node)]
    if len(owners) > 1:
        names = " and ".join(f"'{node.full_name}'" for node in owners)
        text = f"{names} both publish /clock: time jumps back and forth for every node"
        diagnostics.report("doctor.two-clocks", text, owners[1].spec.span)
    _check_names(launched, diagnostics)
    _check_value(launched, owners, diagnostics)
    _check_pause(launched, starts, diagnostics)


def _owns_clock(node: LaunchedNode) -> bool:
    plays = (node.spec.package, node.spec.type) == ("rosbag", "play")
    return node.role is Role.SIMULATOR or (plays and "--clock" in node.program.words)


def _check_names(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report values under names that no node of ROS 1 looks at."""
    fix = f'write <param name="{_NAME}" …/> with the slash'
    for name, value in launched.config.params.items():
        last = name.rpartition("/")[2]
        if name == _NAME or not isinstance(value, bool):
            continue
        if last == _WORD:
            text = f"parameter '{name}' has no effect: nodes of ROS 1 look at {_NAME} only"
        elif _is_misspelled(last):
            text = f"parameter '{name}' is looked at by no node; did you mean '{_WORD}'?"
        else:
            continue
        place = launched.places.get(name)
        diagnostics.report("doctor.sim-time-name", text, place, fix=fix)


def _is_misspelled(name: str) -> bool:
    """Tell whether a name is a slip for the clock's: ``use_map_topic`` is another thing."""
    words = name.casefold().replace("_", "")
    likeness = SequenceMatcher(None, words, _WORD.replace("_", "")).ratio()
    return name.startswith("use") and likeness >= _MIN_LIKENESS


def _check_value(launched: Launched, owners: list[LaunchedNode], diagnostics: Diagnostics) -> None:
    value = launched.config.params.get(_NAME)
    if owners and value is not True:
        how = "not set" if value is None else f"{value!r}"
        others = [node for node in launched.nodes if _has_a_clock(node)]
        if not others:
            return
        names = ", ".join(node.full_name for node in others[:4])
        text = f"{_NAME} is {how} while '{owners[0].full_name}' publishes /clock: nodes that start "
        text += f"before it sets the parameter keep the wall's time ({names}), and their stamps "
        text += "lie decades apart from the simulator's"
        diagnostics.report("doctor.sim-time-off", text, owners[0].spec.span)
    elif not owners and value is True:
        text = f"{_NAME} is true and nothing in this launch publishes /clock: time stands at 0 "
        text += "until a simulator or `rosbag play --clock` runs elsewhere"
        diagnostics.report("doctor.no-clock", text, launched.places.get(_NAME))


def _has_a_clock(node: LaunchedNode) -> bool:
    """Tell whether a node stamps or compares times on its own."""
    return node.role in {
        Role.STATE_PUBLISHER,
        Role.JOINT_STATES,
        Role.STATIC_TRANSFORM,
        Role.SCRIPT,
        Role.NATIVE,
        Role.BUILTIN,
    }


def _check_pause(
    launched: Launched, starts: Mapping[str, DryStart], diagnostics: Diagnostics
) -> None:
    for name, start in starts.items():
        if start.paused and not start.unpaused_by:
            node = next(item for item in launched.nodes if item.full_name == name)
            text = f"'{name}' starts paused and nothing in this launch unpauses it"
            diagnostics.report("doctor.paused", text, node.spec.span)
