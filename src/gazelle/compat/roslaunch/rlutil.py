"""Small functions of roslaunch (roslaunch.rlutil)."""

from __future__ import annotations

import time
import uuid
from collections.abc import Sequence
from pathlib import Path

from gazelle.compat.roslaunch.core import RLException
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GraphError, NotFoundError
from gazelle.graph import Graph
from gazelle.workspace import Workspace

__all__ = ["configure_logging", "get_or_generate_uuid", "resolve_launch_arguments"]

_PAUSE_S = 0.1


def resolve_launch_arguments(args: Sequence[str]) -> list[str]:
    """Return the launch files meant, and what follows them.

    Args:
        args: a package and a file in it, or files; ``name:=value`` words are left out.

    Raises:
        RLException: there is no such file.
    """
    files = [one for one in args if ":=" not in one]
    if not files:
        raise RLException("no launch file was named")
    if len(files) == 1 or Path(files[0]).is_file():
        if not Path(files[0]).is_file():
            raise RLException(f"[{files[0]}] is not a launch file name")
        return [str(Path(files[0]).resolve()), *files[1:]]
    package, file, *rest = files
    try:
        folder = Workspace.discover().package(package).share
    except NotFoundError as error:
        text = f"[{file}] is neither a launch file in package [{package}] nor is [{package}] a"
        raise RLException(f"{text} launch file name: {error}") from error
    found = sorted(folder.rglob(file))
    if not found:
        near = did_you_mean(file, {path.name for path in folder.rglob("*.launch")})
        text = f"[{file}] is not a launch file in package [{package}]; {near}"
        raise RLException(text.rstrip("; "))
    return [str(found[0]), *rest]


def get_or_generate_uuid(options_runid: str | None, options_wait_for_master: bool = False) -> str:
    """Return a run's identifier: the one given, the running graph's, or a new one.

    Args:
        options_runid: the one given, if any.
        options_wait_for_master: wait for a running graph in place of a new one.
    """
    if options_runid:
        return options_runid
    while True:
        try:
            with Graph.open(role="client") as graph:
                return str(graph.parameters.get("/run_id"))
        except (GraphError, KeyError):
            if not options_wait_for_master:
                return str(uuid.uuid1())
            time.sleep(_PAUSE_S)


def configure_logging(run_id: str) -> None:
    """Do nothing: every launch writes its own log."""
