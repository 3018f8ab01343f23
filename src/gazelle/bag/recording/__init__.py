"""Recording topics of the graph into bags."""

from __future__ import annotations

from gazelle.bag.recording.recorder import Limits, Recorder, Selection
from gazelle.bag.recording.ros1_files import Ros1Files, default_stem

__all__ = ["Limits", "Recorder", "Ros1Files", "Selection", "default_stem"]
