"""Playing bags: their messages on the graph again, at the times they were recorded."""

from __future__ import annotations

from gazelle.bag.playing.controls import Controls
from gazelle.bag.playing.player import Player, PlayOptions, Timeline

__all__ = ["Controls", "PlayOptions", "Player", "Timeline"]
