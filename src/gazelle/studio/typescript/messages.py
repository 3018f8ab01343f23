"""The messages that the page knows by type; each is declared next to what makes it."""

from __future__ import annotations

from typing import Any

from gazelle.sensors.scene_types import (
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
from gazelle.simulator.viewing.broadcast import WorldStats
from gazelle.simulator.viewing.properties import PropertyRow
from gazelle.studio.bags.methods import BagState
from gazelle.studio.bags.player import BagTopic, PlayerState
from gazelle.studio.bags.recorder import RecorderState
from gazelle.studio.displays.display import DisplayRow
from gazelle.studio.displays.finding import AddedDisplays
from gazelle.studio.displays.markers import (
    InteractiveFrame,
    InteractiveMarkers,
    MarkerFrame,
    MarkerList,
    MarkerMesh,
)
from gazelle.studio.errors import ErrorValue
from gazelle.studio.graph_view.actions import ActionOpened, GoalState
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
from gazelle.studio.graph_view.rates import TopicStats
from gazelle.studio.graph_view.reconfigure import (
    DynamicGroupRow,
    DynamicParameterRow,
    Reconfigurable,
)
from gazelle.studio.graph_view.rosout import LogLine
from gazelle.studio.graph_view.topics import EchoedMessage
from gazelle.studio.graph_view.topology import (
    ActionRow,
    GraphValue,
    NodeRow,
    ServiceRow,
    TopicRow,
)
from gazelle.studio.graph_view.transforms import FrameNames, FrameRow, TfFrame
from gazelle.studio.graph_view.types import TypeConstant, TypeField, TypeValue
from gazelle.studio.motion.meshes import MotionMesh
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
from gazelle.studio.plugins.following import PanelEvent
from gazelle.studio.plugins.methods import PanelEntry, PanelInfo
from gazelle.studio.plugins.panel_state import PanelState
from gazelle.studio.plugins.rqt.porting import PortedForm, PortedPlugin, PortedWidget
from gazelle.studio.scenes.shapes import (
    MeshGeometry,
    MeshPartValue,
    MissingGeometry,
    PageGeometry,
)
from gazelle.studio.settings.rviz_files import RvizDisplay, RvizFile, RvizTool, RvizView
from gazelle.studio.world.models import ModelEntry
from gazelle.studio.world.streams import PageScene, WorldJoint

__all__ = ["ADDED", "ALIASES", "MESSAGES", "ROS_MESSAGES"]

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
    *(*_SHAPES, *_PARTS, SceneValue, *_WORLD, *_MOTION, *_BAGS, *_PANELS),
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
