"""Which commands launch something, so that what they say of the user's files is kept."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from itertools import pairwise

from gazelle.errors import GraphError

__all__ = ["Outcome", "journal_of", "launches"]

_HELP = frozenset({"-h", "--help", "--version"})
_ROSLAUNCH = {"--core", "--files", "--args", "--nodes", "--find-node", "--ros-args"}
_ROS2_LAUNCH = {"-p", "--print", "--print-description", "-s", "--show-args", "--show-arguments"}
_ONLY_PRINT: Mapping[tuple[str, ...], frozenset[str]] = {
    ("roslaunch",): _HELP | _ROSLAUNCH | {"--dump-params"},
    ("ros2", "launch"): _HELP | _ROS2_LAUNCH,
    ("gzserver",): _HELP | {"-v"},
    ("gazebo",): _HELP | {"-v"},
    ("gz", "sim"): _HELP | {"--versions"},
    ("ign", "gazebo"): _HELP | {"--versions"},
    ("demo",): _HELP | {"--list", "--copy"},
}
"""Commands that launch → words with which they only print."""


class Outcome:
    """The exit code of a command, set when it has one."""

    code = 1


def launches(words: Sequence[str]) -> bool:
    """Return whether a command line launches something, a word or two of the command first."""
    found = next((each for each in _ONLY_PRINT if tuple(words[: len(each)]) == each), None)
    return found is not None and len(words) > len(found) and not _ONLY_PRINT[found] & set(words)


@contextmanager
def journal_of(words: Sequence[str]) -> Iterator[Outcome]:
    """Keep the journal of a command while it runs; of one that launches nothing there is none."""
    outcome = Outcome()
    if not launches(words):
        yield outcome
        return
    # Most commands launch nothing, and are to start soon.
    from gazelle.diagnostics.launch_journal import begin, end

    file = begin(words, _port(words))
    try:
        yield outcome
    except SystemExit as stop:
        outcome.code = stop.code if isinstance(stop.code, int) else 1
        raise
    finally:
        end(file, outcome.code)


def _port(words: Sequence[str]) -> int:
    from gazelle.graph.sessions import port_of

    if words[0] == "roslaunch":
        named = [new for old, new in pairwise(words) if old in ("-p", "--port")]
        if named and named[-1].isdigit():
            return int(named[-1])
    # A variable that nobody can read is told when the graph is opened.
    with suppress(GraphError):
        return port_of(os.environ)
    return 0
