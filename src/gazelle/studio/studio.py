"""One Studio: its node on the graph, and the parts that methods, streams and paths work on."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

from gazelle.graph import Graph
from gazelle.studio.bags.methods import Bags
from gazelle.studio.bags.player import Playing
from gazelle.studio.bags.recorder import Recording
from gazelle.studio.displays.topic_display import DisplayContext
from gazelle.studio.downloads import Downloads
from gazelle.studio.frame_manager import Frames
from gazelle.studio.graph_view.methods import graph_parts
from gazelle.studio.launches.demos import DemoRunner
from gazelle.studio.lazy_parts import closed_with
from gazelle.studio.pages import Pages
from gazelle.studio.plugins.shown_panels import ShownPanels
from gazelle.studio.robot_files.methods import robot_file_parts
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.scenes.robot import RobotContext
from gazelle.studio.setup_assistant.sessions import AssistantSessions
from gazelle.studio.subscriptions import Subscriptions
from gazelle.studio.workers import Workers
from gazelle.studio.world.methods import world_parts

__all__ = ["Studio"]

_WORKERS = 2


class Studio:
    """One Studio: a node on the graph and the pages that look through it.

    It makes the parts and closes them. Whoever does something for a page takes the part that it
    works on; the Studio is known to the server and to the table of all methods alone.

    Attributes:
        node: the node that subscribes, publishes and calls for all pages.
        pages: the open connections.
        workers: threads that make frames.
        subscriptions: the topics listened to.
        assets: meshes and textures that pages load.
        downloads: files that pages have made.
        graph_view: the graph itself: topics, nodes, parameters, frames.
        displays: what displays show messages with.
        robots: descriptions of robots.
        robot_files: files of robots that were dropped on a page.
        world: the running world.
        bags: recorder and player.
        setup_assistant: MoveIt config packages that pages make.
        shown_panels: the user's own panels.
        demos: starts our demos, for pages of this machine.
    """

    def __init__(self, graph: Graph, folder: Path | None = None) -> None:
        """Join as a node of a name of its own; the graph stays open when Studio is closed.

        Args:
            graph: what to look at.
            folder: where pages may write files, the current one when None; nowhere else.
        """
        self._ending = ending = ExitStack()
        self.node = graph.create_node("_studio", anonymous=True, rosout=False, is_ros2=True)
        ending.callback(self.node.shutdown, "Studio was closed")
        self.workers = closed_with(ending, Workers(_WORKERS))
        self.pages = Pages(self.node)
        self.subscriptions = Subscriptions(self.node)
        self.assets = Assets()
        self.downloads = Downloads()
        frames = Frames(self.node)
        self.graph_view = graph_parts(self.subscriptions, frames, self.pages, ending)
        self.displays = DisplayContext(self.subscriptions, frames, self.assets)
        self.robots = RobotContext(self.subscriptions, self.assets)
        self.robot_files = robot_file_parts(self.assets, ending)
        self.world = world_parts(self.subscriptions, self.workers, self.assets, ending)
        written = (folder or Path.cwd()).absolute()
        self.setup_assistant = AssistantSessions(written, self.assets)
        recording = Recording(graph, written)
        self.bags = Bags(closed_with(ending, recording), closed_with(ending, Playing(graph)))
        self.demos = closed_with(ending, DemoRunner(graph.port, self.pages))
        self.shown_panels = closed_with(ending, ShownPanels(graph))

    def close(self) -> None:
        """Leave the graph; what was made last ends first."""
        self._ending.close()
