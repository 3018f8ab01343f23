"""The messages that the page knows by type; each is declared next to what makes it."""

from __future__ import annotations

from gazelle.studio.displays.display import DisplayRow
from gazelle.studio.displays.finding import AddedDisplays
from gazelle.studio.errors import ErrorValue
from gazelle.studio.graph_view.echo import EchoedMessage
from gazelle.studio.graph_view.plot import PlotCurves, PlotPoints
from gazelle.studio.graph_view.rates import TopicStats
from gazelle.studio.graph_view.rosout import LogLine
from gazelle.studio.graph_view.topology import (
    ActionRow,
    GraphValue,
    NodeRow,
    ServiceRow,
    TopicRow,
)
from gazelle.studio.graph_view.transforms import FrameNames, FrameRow, TfFrame
from gazelle.studio.session import GraphPlace, Hello, Show

__all__ = ["MESSAGES"]

_SESSION = (GraphPlace, Hello, Show, ErrorValue)
_GRAPH = (NodeRow, TopicRow, ServiceRow, ActionRow, GraphValue)
_TOPICS = (TopicStats, EchoedMessage, PlotCurves, PlotPoints, LogLine)
_FRAMES = (TfFrame, FrameNames, FrameRow)
_DISPLAYS = (DisplayRow, AddedDisplays)

MESSAGES: tuple[type, ...] = (*_SESSION, *_GRAPH, *_TOPICS, *_FRAMES, *_DISPLAYS)
"""`TypedDict` classes, those that belong together beside each other."""
