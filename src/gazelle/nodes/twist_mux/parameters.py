"""Parameters of ``twist_mux``: topics and locks of both generations, stamps of velocities."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.parameters import Parameter

if TYPE_CHECKING:
    from gazelle.parameters.reader import ParameterReader

__all__ = ["USE_STAMPED", "Choice", "Input", "is_stamped", "read_inputs"]


USE_STAMPED = Parameter(
    "use_stamped", "flag", None, "velocities have stamps; from Jazzy on they have by default"
)
_STAMPED = frozenset({"jazzy", "kilted", "rolling"})
_MEMBERS = ("topic", "timeout", "priority")
_MAX = 255
_PARSING = "ROS says: Error parsing params"

_FIX = {
    "topics": "topics: {keyboard: {topic: key_vel, timeout: 0.5, priority: 90}}",
    "locks": "locks: {pause: {topic: pause_navigation, timeout: 0.0, priority: 100}}",
}


@dataclass(slots=True)
class Input:
    """A topic with velocities, or a lock.

    Attributes:
        name: in the parameters.
        topic: as written.
        timeout_s: when its last message is too old; 0 for never.
        priority: 0 to 255.
        heard_ns: time of its last message; 0 before the first, which counts as too old.
        locked: what a lock said last.
    """

    name: str
    topic: str
    timeout_s: float
    priority: int
    heard_ns: int = 0
    locked: bool = False

    def is_old(self, now_ns: int) -> bool:
        """Tell whether its time is over."""
        return self.timeout_s > 0 and (now_ns - self.heard_ns) / 1e9 > self.timeout_s

    def is_locked(self, now_ns: int) -> bool:
        """Tell whether a lock holds: it says so, or it has not spoken in time."""
        return self.is_old(now_ns) or self.locked

    def is_masked(self, now_ns: int, lock_priority: int) -> bool:
        """Tell whether a topic does not count: too old, or held by a lock."""
        return self.is_old(now_ns) or self.priority < lock_priority


@dataclass(frozen=True, slots=True)
class Choice:
    """Which topic passes.

    Attributes:
        topics, locks: in the order of the parameters.
    """

    topics: tuple[Input, ...]
    locks: tuple[Input, ...]

    def lock_priority(self, now_ns: int) -> int:
        """Return the priority of the highest lock that holds, 0 when none does."""
        return max((one.priority for one in self.locks if one.is_locked(now_ns)), default=0)

    def passes(self, wanted: Input, now_ns: int) -> bool:
        """Tell whether a topic is the one with the highest priority, of equals the first."""
        held, best, name = self.lock_priority(now_ns), 0, ""
        for one in self.topics:
            if one.priority > best and not one.is_masked(now_ns, held):
                best, name = one.priority, one.name
        return wanted.name == name


def is_stamped(own: ParameterReader) -> bool:
    """Tell what ``~use_stamped`` says; from Jazzy on it is true unless told otherwise."""
    newer = own.ros_version == 2 and os.environ.get("ROS_DISTRO", "") in _STAMPED
    return own.flag("use_stamped", newer)


def read_inputs(kind: str, given: Any, owner: str, found: Diagnostics) -> tuple[Input, ...]:
    """Return topics or locks: ROS 1's list with names, or ROS 2's groups by name.

    Args:
        kind: ``topics`` or ``locks``.
        given: the parameter's value, None when there is none.
        owner: what messages call the node.
        found: receives what is wrong; an input that is not whole is left out.
    """
    if given is None:
        return ()
    inputs = [
        one
        for name, group in _groups(kind, given, owner, found)
        if (one := _input(name, group, owner, found)) is not None
    ]
    for one in inputs if kind == "topics" else ():
        if one.priority == 0:
            text = f"{owner}: topic '{one.name}' has priority 0, which never passes, as in ROS"
            found.report("parameter.bad-value", text, fix="write a priority from 1 to 255")
    return tuple(inputs)


def _groups(
    kind: str, given: Any, owner: str, found: Diagnostics
) -> Iterator[tuple[str, Mapping[str, Any]]]:
    if isinstance(given, Mapping):
        # ROS 2 goes through them by name; the order counts where priorities are equal.
        items: Sequence[tuple[Any, Any]] = [(f"{kind}.{key}", given[key]) for key in sorted(given)]
    elif isinstance(given, list | tuple):
        items = [(_name(item, f"{kind}[{place}]"), item) for place, item in enumerate(given)]
    else:
        items = [(kind, given)]
    for name, item in items:
        if isinstance(item, Mapping):
            yield str(name), item
            continue
        text = f"{owner}: '{name}' is {item!r}, not a group of topic, timeout and priority"
        found.report("parameter.bad-value", f"{text} ({_PARSING})", fix=_FIX[kind])


def _name(item: Any, fallback: str) -> str:
    return str(item.get("name", fallback)).strip() if isinstance(item, Mapping) else fallback


def _input(name: str, group: Mapping[str, Any], owner: str, found: Diagnostics) -> Input | None:
    missing = [member for member in _MEMBERS if member not in group]
    if missing:
        others = [str(key) for key in group if key not in (*_MEMBERS, "name")]
        hints = filter(None, (did_you_mean(member, others) for member in missing))
        text = f"{owner}: '{name}' has no {' and no '.join(missing)}; it is left out ({_PARSING})"
        fix = next(hints, f"add {', '.join(missing)} to '{name}'")
        found.report("parameter.bad-value", text, fix=fix)
        return None
    numbers = [_number(group[member]) for member in ("timeout", "priority")]
    for member, number in zip(("timeout", "priority"), numbers, strict=True):
        if number is None:
            text = f"{owner}: '{name}': {member} is {group[member]!r}, not a number; "
            found.report("parameter.bad-value", f"{text}it is left out", fix="write a number")
    timeout_s, priority = numbers
    if timeout_s is None or priority is None:
        return None
    return Input(name, str(group["topic"]), timeout_s, min(max(int(priority), 0), _MAX))


def _number(value: Any) -> float | None:
    return None if isinstance(value, bool) or not isinstance(value, int | float) else float(value)
