"""Recording topics of the graph into bags."""

from __future__ import annotations

from gazelle.bag.recording.files import Ros1Files, default_stem
from gazelle.bag.recording.recorder import Limits, Recorder, Selection

__all__ = ["Limits", "Recorder", "Ros1Files", "Selection", "default_stem"]
