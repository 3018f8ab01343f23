"""``motion.robot``: the robot as move_group knows it: groups, named states, limits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypedDict

from gazelle.graph import Graph, Kind
from gazelle.sensors.scene_json_types import SceneValue
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.scenes.robot import RobotContext, description_text
from gazelle.studio.scenes.shapes import PageGeometry, page_scene
from gazelle.studio.subscriptions import Subscriptions

if TYPE_CHECKING:
    from gazelle.motion.model import JointGroup, RobotModel

__all__ = [
    "MotionEffector",
    "MotionGroup",
    "MotionJoint",
    "MotionMimic",
    "MotionPart",
    "MotionRobot",
    "MotionVariable",
    "get_motion_robot",
    "motion_part",
]

_PLAN = "plan_kinematic_path"
_TYPE = "moveit_msgs/srv/GetMotionPlan"
_DESCRIPTION = "robot_description"
_PARTS = ("", "_semantic", "_kinematics", "_planning")
_START = (
    "start it in a terminal with the launch file of the arm's MoveIt configuration: "
    "ros2 launch PACKAGE move_group.launch.py, in ROS 1 roslaunch PACKAGE move_group.launch; "
    "this page looks for it again and again"
)


class MotionVariable(TypedDict):
    """A variable of a joint, rad or m; null where there is no limit."""

    name: str
    lower: float | None
    upper: float | None


class MotionJoint(TypedDict):
    """A joint that can move."""

    name: str
    kind: str
    child: str
    variables: list[MotionVariable]


class MotionMimic(TypedDict):
    """A variable that follows another one."""

    variable: str
    leader: str
    factor: float
    offset: float


class MotionEffector(TypedDict):
    """An end effector: the link that carries it, and links of its own."""

    name: str
    link: str
    links: list[str]


class MotionGroup(TypedDict):
    """A planning group.

    Attributes:
        active: joints that are planned for.
        states: positions of its named states.
    """

    name: str
    variables: list[str]
    active: list[str]
    links: list[str]
    tips: list[str]
    effectors: list[MotionEffector]
    states: dict[str, dict[str, float]]
    is_chain: bool


class MotionPart(TypedDict):
    """What a robot's own description and its groups say."""

    name: str
    frame: str
    root: str
    velocity_scaling: float
    acceleration_scaling: float
    default_pipeline: str
    defaults: dict[str, float]
    mimics: list[MotionMimic]
    joints: list[MotionJoint]
    groups: list[MotionGroup]


class MotionRobot(MotionPart):
    """A robot as its move_group knows it.

    Attributes:
        prefix: what names of this move_group begin with: `/`.
        frame: the planning frame.
    """

    node: str
    prefix: str
    scene: SceneValue[PageGeometry]


def get_motion_robot(robots: RobotContext, params: Params) -> MotionRobot:
    """Return groups, joints, states and shapes of the robot of a move_group.

    ``namespace`` is that of the move_group, ``description`` the name of the parameter.
    """
    # Readers of descriptions take a third of the server's start; few pages plan motions.
    from gazelle.description.moveit import config_from_parameters
    from gazelle.diagnostics import Diagnostics
    from gazelle.motion.model import RobotModel
    from gazelle.sensors.scene_json import robot_value
    from gazelle.workspace import Workspace

    description = params.text("description", _DESCRIPTION).lstrip("/") or _DESCRIPTION
    node, prefix = _move_group(robots.subscriptions.node.graph, params.text("namespace", ""))
    found = Diagnostics()
    tree = _parameters(robots.subscriptions, node, prefix, description)
    config = config_from_parameters(
        tree, workspace=Workspace.discover(), diagnostics=found, description=description
    )
    if config is None:
        reasons = "\n".join(str(item.message) for item in found)
        raise StudioError(f"{node} has no '{description}' that can be read", hint=reasons)
    robot = RobotModel.from_config(config, diagnostics=found)
    return {
        "node": node,
        "prefix": prefix,
        **motion_part(
            robot, config.velocity_scaling, config.acceleration_scaling, config.default_pipeline
        ),
        "scene": page_scene(robot_value(robot.description), robots.assets),
    }


def _move_group(graph: Graph, namespace: str) -> tuple[str, str]:
    """Return a move_group's node and what its names begin with."""
    offered = {
        one.name: one.node
        for one in graph.entities()
        if one.kind is Kind.SERVICE and one.type_name == _TYPE and one.name.endswith(f"/{_PLAN}")
    }
    if not offered:
        raise StudioError("no move_group is running on this graph", hint=_START)
    wanted = f"/{namespace.strip('/')}/{_PLAN}".replace("//", "/")
    if wanted not in offered and (namespace.strip("/") or len(offered) > 1):
        text = f"there is no move_group in namespace '{namespace}'"
        raise StudioError(text, known=sorted(_before(name) for name in offered))
    name = wanted if wanted in offered else next(iter(offered))
    return offered[name], _before(name)


def _before(service: str) -> str:
    return service.removesuffix(_PLAN)


def _parameters(
    subscriptions: Subscriptions, node: str, prefix: str, description: str
) -> dict[str, Any]:
    """ROS 2 gives a move_group its parameters, ROS 1 has the descriptions beside it."""
    from gazelle.parameters.trees import nested

    store = subscriptions.node.graph.parameters
    own = store.get(node) if store.has(node) else {}
    tree = nested(own) if isinstance(own, Mapping) else {}
    for part in _PARTS:
        name = f"{description}{part}"
        for parameter in (f"{prefix}{name}", f"/{name}"):
            if name not in tree and store.has(parameter):
                value = store.get(parameter)
                tree[name] = nested(value) if isinstance(value, Mapping) else value
    for name in (description, f"{description}_semantic"):
        if not tree.get(name):
            tree[name] = _of_topic(subscriptions, f"{prefix}{name}")
    return tree


def _of_topic(subscriptions: Subscriptions, topic: str) -> str:
    """A description that is no parameter is on a topic of its name."""
    if topic not in {one.name for one in subscriptions.node.graph.topics()}:
        raise StudioError(f"there is neither a parameter nor a topic '{topic}'", hint=_START)
    return description_text(subscriptions, topic)


def motion_part(
    robot: RobotModel,
    velocity_scaling: float,
    acceleration_scaling: float,
    default_pipeline: str = "",
) -> MotionPart:
    """Return a robot's joints and groups as the page takes them.

    Args:
        robot: with its groups.
        velocity_scaling: share of the limits that is used unless a request says more.
        acceleration_scaling: the same of acceleration.
        default_pipeline: used when a request names none.
    """
    return {
        "name": robot.name,
        "frame": robot.frame,
        "root": robot.root_link,
        "velocity_scaling": velocity_scaling,
        "acceleration_scaling": acceleration_scaling,
        "default_pipeline": default_pipeline,
        "defaults": robot.named(robot.default_positions()),
        "mimics": [
            {"variable": one.variables[0], "leader": leader, "factor": factor, "offset": offset}
            for one in robot.joints
            if one.mimic is not None and one.variables
            for leader, factor, offset in [robot.mimic_of(one.variables[0])]
        ],
        "joints": [_joint_value(one) for one in robot.joints if one.variables],
        "groups": [_group_value(robot, one) for one in robot.groups.values()],
    }


def _joint_value(joint: Any) -> MotionJoint:
    limits: list[MotionVariable] = [
        {
            "name": name,
            "lower": None if limit.continuous else _finite(limit.lower),
            "upper": None if limit.continuous else _finite(limit.upper),
        }
        for name, limit in zip(joint.variables, joint.limits, strict=True)
    ]
    return {"name": joint.name, "kind": joint.kind.value, "child": joint.child, "variables": limits}


def _finite(value: float) -> float | None:
    return value if abs(value) < 1e6 else None


def _group_value(robot: RobotModel, group: JointGroup) -> MotionGroup:
    effectors = [one for one in robot.srdf.end_effectors if one.name in group.end_effectors]
    return {
        "name": group.name,
        "variables": list(group.variables),
        "active": list(group.active_joints),
        "links": list(group.moved_links),
        "tips": list(group.tip_links),
        "effectors": [
            {"name": one.name, "link": one.parent_link, "links": list(_links(robot, one.group))}
            for one in effectors
        ],
        "states": {name: dict(values) for name, values in group.states.items()},
        "is_chain": group.is_chain,
    }


def _links(robot: RobotModel, group: str) -> tuple[str, ...]:
    return robot.groups[group].links if group in robot.groups else ()
