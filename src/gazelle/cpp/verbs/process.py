"""Verbs of the process."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []


@verb("process/leave")
def leave(host: HostContext, request: dict[str, Any]) -> None:
    """Leave the graph, at the end of the program."""
    del request
    host.leave()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            # Its reader has gone, or the program closed it.
            continue
