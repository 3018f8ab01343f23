"""Verbs of time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []


@verb("clock/use")
def use(host: HostContext, request: dict[str, Any]) -> None:
    """Choose simulated or wall time whatever ``/use_sim_time`` says; null lets it say."""
    if host.has_graph:
        host.graph.clock.use(request["sim_time"])


@verb("clock/prefer")
def prefer(host: HostContext, request: dict[str, Any]) -> None:
    """Let messages tell the time, as most sleeps are too short for a page, or let them not."""
    if host.has_graph:
        host.graph.clock.prefer_messages(messages=request["messages"])
