"""The page's generated sources, and the messages in them that it knows by type.

Each message is declared next to what makes it.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from gazelle.bag.formats import OWN_FORMATS
from gazelle.bag.storage import Encoding
from gazelle.sensors.scene_json_types import (
    BodyValue,
    BoxGeometry,
    EllipsoidGeometry,
    InertialValue,
    JointValue,
    LightValue,
    MaterialValue,
    MimicValue,
    ModelValue,
    PlaneGeometry,
    RoundGeometry,
    SceneValue,
    SensorValue,
    ShapeValue,
    SphereGeometry,
)
from gazelle.simulator.gui.properties import PropertyRow
from gazelle.simulator.gui.scene_broadcaster import WorldStats
from gazelle.studio.bags.methods import BagState
from gazelle.studio.bags.player import BagTopic, PlayerState
from gazelle.studio.bags.recorder import RecorderState
from gazelle.studio.displays.display import DisplayRow, display_row
from gazelle.studio.displays.markers import (
    InteractiveFrame,
    InteractiveMarkers,
    MarkerFrame,
    MarkerList,
    MarkerMesh,
)
from gazelle.studio.displays.methods import AddedDisplays
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.errors import ErrorValue
from gazelle.studio.graph_view.actions import ActionOpened, GoalState
from gazelle.studio.graph_view.node_graph import (
    ActionRow,
    GraphValue,
    NodeRow,
    ServiceRow,
    TopicRow,
)
from gazelle.studio.graph_view.nodes import (
    EndpointRow,
    LoggerNode,
    LoggerRow,
    NodeInfo,
    NodeKill,
)
from gazelle.studio.graph_view.parameters import NodeParameter, ParameterDescriptor, ParameterRow
from gazelle.studio.graph_view.plot import PlotCurves, PlotPoints
from gazelle.studio.graph_view.publishers import PublisherCount, PublisherRow
from gazelle.studio.graph_view.reconfigure import (
    DynamicGroupRow,
    DynamicParameterRow,
    Reconfigurable,
)
from gazelle.studio.graph_view.rosout import LogLine
from gazelle.studio.graph_view.topics import EchoedMessage, TopicStats
from gazelle.studio.graph_view.transforms import FrameNames, FrameRow, TfFrame
from gazelle.studio.graph_view.types import TypeConstant, TypeField, TypeValue
from gazelle.studio.launches.demos import DemoCard, DemoStep, DemosValue
from gazelle.studio.launches.findings import FoundIn, LaunchFinding, LaunchValue, SourceLine
from gazelle.studio.launches.recent import RecentLaunch
from gazelle.studio.motion.methods import MotionMesh
from gazelle.studio.motion.planning_scene import PlanningScene
from gazelle.studio.motion.robot import (
    MotionEffector,
    MotionGroup,
    MotionJoint,
    MotionMimic,
    MotionRobot,
    MotionVariable,
)
from gazelle.studio.pages import GraphPlace, Hello, Show
from gazelle.studio.plugins.methods import PanelEntry, PanelInfo
from gazelle.studio.plugins.panel_state import PanelState
from gazelle.studio.plugins.rqt.porting import PortedForm, PortedPlugin, PortedWidget
from gazelle.studio.plugins.shown_panels import PanelEvent
from gazelle.studio.protocol import STREAMS
from gazelle.studio.robot_files.methods import RobotFile
from gazelle.studio.scenes.shapes import (
    MeshGeometry,
    MeshPartValue,
    MissingGeometry,
    PageGeometry,
)
from gazelle.studio.settings.rviz_files import RvizDisplay, RvizFile, RvizTool, RvizView
from gazelle.studio.setup_assistant.values import (
    AssistantChain,
    AssistantController,
    AssistantEffector,
    AssistantFile,
    AssistantGroup,
    AssistantInterface,
    AssistantLink,
    AssistantPair,
    AssistantStart,
    AssistantState,
    AssistantValue,
    AssistantVirtualJoint,
    AssistantWritten,
)
from gazelle.studio.typescript.interfaces import interface, ros_interfaces, type_text
from gazelle.studio.world.models import ModelEntry
from gazelle.studio.world.streams import PageScene, WorldJoint

__all__ = ["ADDED", "ALIASES", "FILES", "FOLDER", "MESSAGES", "ROS_MESSAGES"]

_SESSION = (GraphPlace, Hello, Show, ErrorValue)
_GRAPH = (NodeRow, TopicRow, ServiceRow, ActionRow, GraphValue)
_NODES = (EndpointRow, NodeInfo, NodeKill, LoggerNode, LoggerRow)
_TALKS = (PublisherCount, PublisherRow, ActionOpened, GoalState)
_TOPICS = (TopicStats, EchoedMessage, PlotCurves, PlotPoints, LogLine)
_TYPES = (TypeConstant, TypeField, TypeValue)
_FRAMES = (TfFrame, FrameNames, FrameRow)
_DYNAMIC = (DynamicParameterRow, DynamicGroupRow, Reconfigurable)
_PARAMETERS = (ParameterRow, ParameterDescriptor, NodeParameter, *_DYNAMIC)
_DISPLAYS = (DisplayRow, AddedDisplays, RvizDisplay, RvizTool, RvizView, RvizFile)
_MARKERS = (MarkerMesh, MarkerList, MarkerFrame, InteractiveMarkers, InteractiveFrame)
_SOLIDS = (BoxGeometry, SphereGeometry, RoundGeometry, EllipsoidGeometry, PlaneGeometry)
_SHAPES = (MaterialValue, *_SOLIDS, MeshPartValue, MeshGeometry, MissingGeometry, ShapeValue)
_PARTS = (InertialValue, SensorValue, LightValue, BodyValue, MimicValue, JointValue, ModelValue)
_WORLD = (WorldStats, WorldJoint, PropertyRow, ModelEntry)
_MOTION_PARTS = (MotionVariable, MotionJoint, MotionMimic, MotionEffector, MotionGroup)
_MOTION = (*_MOTION_PARTS, MotionRobot, MotionMesh, PlanningScene)
_LAUNCHES = (SourceLine, LaunchFinding, LaunchValue, FoundIn, RecentLaunch, RobotFile)
_DEMOS = (DemoStep, DemoCard, DemosValue)
_ASSISTANT_SRDF = (AssistantPair, AssistantVirtualJoint, AssistantChain, AssistantGroup)
_ASSISTANT_PARTS = (AssistantState, AssistantEffector, AssistantController, AssistantInterface)
_ASSISTANT_FILES = (AssistantStart, AssistantFile, AssistantWritten)
_ASSISTANT = (*_ASSISTANT_SRDF, *_ASSISTANT_PARTS, AssistantLink, AssistantValue)
_BAGS = (BagTopic, RecorderState, PlayerState, BagState)
_PORTING = (PortedWidget, PortedForm, PortedPlugin)
_PANELS = (PanelEntry, PanelInfo, PanelEvent, PanelState, *_PORTING)

MESSAGES: tuple[type, ...] = (
    *(
        *_SESSION,
        *_GRAPH,
        *_NODES,
        *_TALKS,
        *_TOPICS,
        *_TYPES,
        *_FRAMES,
        *_PARAMETERS,
        *_DISPLAYS,
        *_MARKERS,
    ),
    *(
        *_SHAPES,
        *_PARTS,
        SceneValue,
        *_WORLD,
        *_MOTION,
        *_ASSISTANT,
        *_ASSISTANT_FILES,
        *_LAUNCHES,
        *_DEMOS,
        *_BAGS,
        *_PANELS,
    ),
)
"""`TypedDict` classes, and `NamedTuple` ones that are sent as such."""

ROS_MESSAGES = (
    "geometry_msgs/msg/PoseStamped",
    "visualization_msgs/msg/Marker",
    "visualization_msgs/msg/InteractiveMarker",
    "visualization_msgs/msg/InteractiveMarkerPose",
)
"""Messages of ROS of which the page reads fields; those inside of them come with them."""

ADDED: dict[str, type] = {"visualization_msgs/msg/Marker": MarkerMesh}
"""What the server adds to the fields of a message."""

ALIASES: dict[str, Any] = {
    "PageBody": BodyValue[PageGeometry],
    "PageGeometry": PageGeometry,
    "PageScene": PageScene,
    "PageShape": ShapeValue[PageGeometry],
}
"""Names of types that are made of these."""

FOLDER = "studio/src/generated"
_HEAD = "/** {what}. Generated: `python -m gazelle.studio.typescript`. */\n"


def _displays() -> str:
    rows = "".join(
        f"  {row.name}: {json.dumps(display_row(row), ensure_ascii=False)},\n"
        for row in DISPLAYS.values()
    )
    return (
        _HEAD.format(what="The rows of `gazelle.studio.displays.registry`")
        + "import type { DisplayRow } from './messages';\n\n"
        + f"export const DISPLAY_ROWS = {{\n{rows}}} satisfies Record<string, DisplayRow>;\n\n"
        + "export type DisplayName = keyof typeof DISPLAY_ROWS;\n"
    )


def _drawings() -> str:
    used: dict[str, set[str]] = {}
    rows = []
    for display in DISPLAYS.values():
        module, _, constant = display.drawing.partition(":")
        used.setdefault(module, set()).add(constant)
        rows.append(f"  {display.name}: {constant},\n")
    imports = [
        f"import {{ {', '.join(sorted(names))} }} from '../{module}';\n"
        for module, names in sorted(used.items())
    ]
    return (
        _HEAD.format(what="What draws the displays of `gazelle.studio.displays.registry`")
        + "import type { Drawing } from '../displays/display';\n"
        + "".join(imports)
        + "import type { DisplayName } from './displays';\n\n"
        + f"export const DRAWINGS: Record<DisplayName, Drawing> = {{\n{''.join(rows)}}};\n"
    )


def _bags() -> str:
    kinds = {Encoding.ROS1: "ROS 1", Encoding.CDR: "rosbag2"}
    rows = "".join(
        f"  [{json.dumps(one.suffix.removeprefix('.'))},"
        f" {json.dumps(f'{kinds[one.encoding]} {one.suffix}')}],\n"
        for one in OWN_FORMATS
    )
    return (
        _HEAD.format(what="What topics are recorded into: the formats of `gazelle.bag.formats`")
        + f"export const BAG_FORMATS = [\n{rows}] as const;\n"
    )


def _messages() -> str:
    aliases = (f"export type {name} = {type_text(kind)};\n" for name, kind in ALIASES.items())
    of_ros = ros_interfaces(ROS_MESSAGES, ADDED)
    text = "\n".join((*map(interface, MESSAGES), *of_ros, *aliases))
    json_type = "import type { Json } from '../json';\n" if "Json" in text else ""
    what = "What the server sends, as its Python types declare it"
    return f"{_HEAD.format(what=what)}{json_type}\n{text}"


def _streams() -> str:
    latest = [name for name, kind in sorted(STREAMS.items()) if kind.latest]
    rows = "".join(f"  {json.dumps(name)},\n" for name in latest)
    return (
        _HEAD.format(what="Streams of which only the newest item counts; these are acknowledged")
        + f"export const LATEST_STREAMS: ReadonlySet<string> = new Set([\n{rows}]);\n"
    )


FILES: dict[str, Callable[[], str]] = {
    "bags.ts": _bags,
    "displays.ts": _displays,
    "drawings.ts": _drawings,
    "messages.ts": _messages,
    "streams.ts": _streams,
}
"""Their names and what gives their texts."""
