"""``libgazebo_ros_joint_pose_trajectory``: puts joints to the points of a trajectory in turn."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose
from gazelle.interfaces.poses import pose_of
from gazelle.interfaces.stamps import ns_of
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]

_WORLDS = frozenset({"world", "map", "/map"})

TABLE = PluginTable(
    ParameterTable(
        "joint_pose_trajectory",
        "Puts joints to the positions of a trajectory's points, without any controller.",
        ("gazebo_ros_joint_pose_trajectory",),
        (
            Parameter(
                "robotNamespace", "text", "", "namespace of topic and service", ros_versions=(1,)
            ),
            Parameter(
                "topicName", "text", "set_joint_trajectory", "trajectories", ros_versions=(1,)
            ),
            Parameter(
                "serviceName",
                "text",
                "set_joint_trajectory",
                "the same as a service",
                ros_versions=(1,),
            ),
            Parameter(
                "updateRate",
                "number",
                0.0,
                "how often points are looked for; 100 in ROS 2",
                "Hz",
                aliases=("update_rate",),
            ),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "trajectory_msgs/msg/JointTrajectory",
            kind="listens",
            ros2="set_joint_trajectory",
        ),
    ),
    services=(
        Topic("{serviceName} (ROS 1)", "gazebo_msgs/srv/SetJointTrajectory", kind="service"),
    ),
    behaviour=(
        "A point is taken at once when its turn comes; the next one follows after its"
        " `time_from_start` (counted from the point before, as Gazebo does).",
        "The model, or the link that `header.frame_id` names, stays where it is while joints jump;"
        " afterwards they are free.",
    ),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start listening for trajectories."""
    parameters = context.reader(TABLE)
    _Trajectories(context, parameters)
    parameters.report_unread()


@dataclass(slots=True)
class _Course:
    """A trajectory that is under way."""

    model: str
    link: str
    joints: list[str]
    points: list[Any]
    due_ns: int


class _Trajectories:
    """One running plug-in."""

    def __init__(self, context: PluginContext, parameters: PluginReader) -> None:
        self._context = context
        self._engine = context.host.engine
        self._course: _Course | None = None
        resources = context.resources
        topic = context.topic(parameters, parameters.text("topicName"))
        resources.subscription(topic, "trajectory_msgs/JointTrajectory", self._take)
        default = 100.0 if parameters.is_ros2() else None
        if default is None and (parameters.ros_version or not parameters.has("updateRate")):
            service = context.topic(parameters, parameters.text("serviceName"))
            resources.service(service, "gazebo_msgs/SetJointTrajectory", self._serve)
        rate = parameters.number("updateRate", default)
        period = period_in_steps(rate, self._engine.step_ns) if rate > 0 else Fraction(1)
        resources.task(
            f"{context.plugin.name} points",
            period,
            self._update,
            wanted=lambda: self._course is not None,
        )
        resources.on_reset(self._stop)

    def _take(self, message: Any) -> None:
        self._begin(self._context.model.name, message)

    def _serve(self, request: Any, response: Any) -> None:
        name = request.model_name or self._context.model.name
        if self._engine.world.model(name) is None:
            response.success = False
            response.status_message = f"there is no model '{name}'"
            return
        if request.set_model_pose:
            self._engine.set_model_pose(name, pose_of(request.model_pose).normalised())
        response.success = self._begin(name, request.joint_trajectory)

    def _begin(self, model: str, message: Any) -> bool:
        link = "" if message.header.frame_id in _WORLDS else message.header.frame_id
        if link and link not in self._engine.link_names:
            self._report("link", link, self._engine.link_names)
            return False
        model = link.partition("::")[0] or model
        described = self._engine.world.model(model)
        assert described is not None
        known = [joint.name for joint in described.joints]
        missing = [name for name in message.joint_names if name not in known]
        if missing:
            self._report("joint", missing[0], known)
            return False
        stamp = message.header.stamp
        due_ns = max(ns_of(stamp), self._engine.time_ns)
        joints = [f"{model}::{name}" for name in message.joint_names]
        self._course = _Course(model, link, joints, list(message.points), due_ns)
        return True

    def _update(self) -> None:
        course = self._course
        if course is None or self._engine.time_ns < course.due_ns:
            return
        if not course.points or self._engine.world.model(course.model) is None:
            self._stop()
            return
        point = course.points.pop(0)
        place = self._place(course)
        for name, position in zip(course.joints, point.positions, strict=False):
            self._engine.joint(name).set_state(float(position))
        if course.link:
            self._engine.link(course.link).set_pose(place)
        else:
            self._engine.set_model_pose(course.model, place)
        wait = point.time_from_start
        course.due_ns += ns_of(wait)

    def _place(self, course: _Course) -> Pose:
        if course.link:
            return self._engine.link(course.link).T_world_link()
        return self._engine.model_pose(course.model)

    def _stop(self) -> None:
        self._course = None

    def _report(self, what: str, name: str, known: Any) -> None:
        text = f"plug-in '{self._context.plugin.name}' was sent a trajectory for {what} '{name}',"
        text += " which is not there; the trajectory is not followed"
        code = "plugin.missing-joint" if what == "joint" else "plugin.missing-link"
        self._context.report(code, text, fix=did_you_mean(name, tuple(known)))
