"""What methods and the stream of bags work on."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.studio.bags.player import Playing
from gazelle.studio.bags.recorder import Recording

__all__ = ["Bags"]


@dataclass(frozen=True)
class Bags:
    """The recorder and the player of a graph's pages."""

    recording: Recording
    playing: Playing
