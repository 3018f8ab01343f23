"""``robot.get``: the scene value of a robot description, from a parameter or a topic."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.sensors.scene_json_types import SceneValue
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.request_params import Params
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.scenes.shapes import PageGeometry, page_scene
from gazelle.studio.subscriptions import Sample, Subscriptions
from gazelle.workspace import Workspace

__all__ = ["RobotContext", "description_text", "get_robot"]

_PARAMETER = "/robot_description"
_TOPIC_S = 2.0


@dataclass(frozen=True)
class RobotContext:
    """What descriptions of robots are read with.

    Attributes:
        subscriptions: topics that bring them; its node has their parameters.
        assets: keeps their meshes for pages.
    """

    subscriptions: Subscriptions
    assets: Assets


def get_robot(robots: RobotContext, params: Params) -> SceneValue[PageGeometry]:
    """``robot.get``: of ``parameter`` or ``topic``, of ``/robot_description`` in either."""
    # Readers of descriptions take a third of the server's start; few pages wait for them.
    from gazelle.description.loader import load_models
    from gazelle.sensors.scene_json import robot_value

    text = _description(robots.subscriptions, params)
    found = Diagnostics()
    models = load_models(text, workspace=Workspace.discover(), diagnostics=found, inserts=False)
    findings: list[dict[str, Any]] = [
        {"level": item.severity.name.lower(), "text": str(item.message), "code": item.code}
        for item in found
    ]
    if not models:
        reasons = "\n".join(item["text"] for item in findings)
        raise StudioError("the robot description cannot be read", hint=reasons)
    value = page_scene(robot_value(models[0]), robots.assets)
    prefix = params.text("tf_prefix", "").strip("/")
    for body in value["bodies"]:
        body["frame"] = f"{prefix}/{body['link']}" if prefix else body["link"]
    value["findings"] = findings
    return value


def _description(subscriptions: Subscriptions, params: Params) -> str:
    if "topic" in params:
        return description_text(subscriptions, params.text("topic"))
    graph, name = subscriptions.node.graph, params.text("parameter", _PARAMETER)
    try:
        value = graph.parameters.get(name)
    except KeyError:
        topics = {one.name for one in graph.topics()}
        if name in topics:
            return description_text(subscriptions, name)
        known = graph.parameters.names()
        raise unknown("parameter or topic", name, {*known, *topics}) from None
    if not isinstance(value, str):
        raise StudioError(f"parameter '{name}' is no text but a {type(value).__name__}")
    return value


def description_text(subscriptions: Subscriptions, topic: str) -> str:
    """Return the latched text of a topic.

    Raises:
        StudioError: none came, or it is no text.
    """
    came = threading.Event()
    samples: list[Sample] = []

    def take(sample: Sample) -> None:
        samples.append(sample)
        came.set()

    end = subscriptions.listen(topic, take)
    came.wait(_TOPIC_S)
    end()
    if not samples:
        raise StudioError(
            f"no robot description came on {topic}",
            hint="robot_state_publisher of ROS 2 publishes it, latched",
        )
    text = getattr(samples[0].message(), "data", None)
    if not isinstance(text, str):
        raise StudioError(f"{topic} is no std_msgs/String")
    return text
