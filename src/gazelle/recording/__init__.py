"""What happened in a world: where everything was over time, and what topics said.

A `Recording` is made of a simulation in this process (`record`), of a running graph
(`GraphRecorder`), of a bag (`bag_recording`) or of one moment (`snapshot`). Films and replays are
made of it afterwards, so nobody waits for them while the world runs.
"""

from __future__ import annotations

from gazelle.recording.bag_recording import bag_recording
from gazelle.recording.graph_recorder import GraphRecorder, NoWorldError
from gazelle.recording.recording import Recording, Stretch, TopicTrack
from gazelle.recording.simulation_recorder import SimulationRecorder, record, snapshot

__all__ = [
    "GraphRecorder",
    "NoWorldError",
    "Recording",
    "SimulationRecorder",
    "Stretch",
    "TopicTrack",
    "bag_recording",
    "record",
    "snapshot",
]
