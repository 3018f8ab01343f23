"""Methods, streams and paths of launches, and what they work on."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.launches.demos import (
    DemoRunner,
    demo_picture,
    list_demos,
    start_demo,
    stop_demo,
)
from gazelle.studio.launches.findings import open_findings
from gazelle.studio.launches.recent import recent_launches
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method, Route
from gazelle.studio.streams import StreamKind

__all__ = ["DEMO_METHODS", "METHODS", "ROUTES", "STREAMS"]

DEMO_METHODS: dict[str, Method[DemoRunner]] = {
    "demo.list": list_demos,
    "demo.start": start_demo,
    "demo.stop": stop_demo,
}
ROUTES: dict[str, Route[object]] = {"demo": demo_picture}
METHODS: dict[str, Callable[[Params], Any]] = {"launch.recent": recent_launches}
STREAMS: dict[str, StreamKind[int]] = {"launch.findings": StreamKind(True, open_findings)}
"""Over the port of the graph."""
