"""Cameras and the frames that are named after them."""

from __future__ import annotations

import re

import numpy as np

from gazelle.description.model import CameraSpec, JointType, Link, Model, Sensor
from gazelle.diagnostics import Diagnostics

__all__ = ["check_cameras"]

_OPTICAL = re.compile(r"optical", re.IGNORECASE)
_RPY = 'rpy="-1.5708 0 -1.5708"'


def check_cameras(model: Model, diagnostics: Diagnostics) -> None:
    """Report cameras on optical frames, and optical frames that are not turned.

    Gazebo's cameras look along x of their link with z up; optical frames of REP 103 and 145 have
    z forward, x right and y down.
    """
    optical = {link.name: link for link in model.links if _OPTICAL.search(link.name)}
    for link in model.links:
        for sensor in link.sensors:
            if isinstance(sensor.spec, CameraSpec):
                if link.name in optical:
                    _check_mounting(link, sensor, model, diagnostics)
                _check_named_frame(link, sensor, optical, model, diagnostics)


def _check_mounting(link: Link, sensor: Sensor, model: Model, diagnostics: Diagnostics) -> None:
    forward = _looks(link, sensor, link)
    if np.allclose(forward, (0.0, 0.0, 1.0), atol=0.1) or not _is_turned(link, model):
        return
    text = (
        f"camera '{sensor.name}' stands on the optical frame '{link.name}': Gazebo's cameras look "
        "along x of their link, which points to the right of an optical frame, so the picture "
        "shows what is beside the robot"
    )
    body = next((item.parent for item in model.joints if item.child == link.name), "")
    fix = (
        f"put the sensor on '{body}' (<gazebo reference=\"{body}\">) and name '{link.name}' as "
        "frameName of its plug-in"
        if body
        else "put the sensor on a link with x forward"
    )
    diagnostics.report("robot.camera-on-optical-frame", text, sensor.span or link.span, fix=fix)


def _check_named_frame(
    link: Link, sensor: Sensor, optical: dict[str, Link], model: Model, diagnostics: Diagnostics
) -> None:
    """Report a frame that is called optical and is not turned; others are the plug-ins' matter."""
    names = {sensor.frame_id}
    if isinstance(sensor.spec, CameraSpec):
        names.add(sensor.spec.optical_frame_id)
    for plugin in sensor.plugins:
        parameter_names = ("frameName", "frame_name", "frame_id")
        names |= {plugin.parameters.text_of(word).strip().lstrip("/") for word in parameter_names}
    for name in sorted(names & set(optical)):
        frame = optical[name]
        if name == link.name and _is_turned(frame, model):
            continue  # said of the mounting
        forward = _looks(link, sensor, frame)
        if np.allclose(forward, (0.0, 0.0, 1.0), atol=0.1):
            continue
        shown = ", ".join(f"{value:.2g}" for value in np.round(forward, 3) + 0.0)
        text = (
            f"frame '{name}' of camera '{sensor.name}' is called optical, but the camera looks "
            f"along ({shown}) of it instead of z: clouds and markers appear turned in RViz"
        )
        joint = next((item for item in model.joints if item.child == name), None)
        fix = f"turn it by its joint: <origin {_RPY}/>, on a parent with x forward"
        span = joint.span if joint is not None else frame.span
        diagnostics.report("robot.optical-frame-not-turned", text, span, fix=fix)


def _looks(link: Link, sensor: Sensor, frame: Link) -> tuple[float, float, float]:
    """Return the direction a camera looks in, in the axes of a frame."""
    T_frame_camera = frame.T_model_link.inverse() @ link.T_model_link @ sensor.T_link_sensor
    if isinstance(sensor.spec, CameraSpec):
        T_frame_camera = T_frame_camera @ sensor.spec.T_sensor_camera
    x, y, z = (float(value) for value in T_frame_camera.rotate((1.0, 0.0, 0.0)))
    return x, y, z


def _is_turned(link: Link, model: Model) -> bool:
    """Tell whether a frame is turned against its parent."""
    joint = next((item for item in model.joints if item.child == link.name), None)
    parent = None if joint is None else model.link(joint.parent)
    if parent is None or joint is None or joint.type is not JointType.FIXED:
        return False
    T_parent_link = parent.T_model_link.inverse() @ link.T_model_link
    return not np.allclose(T_parent_link.rotate((1.0, 0.0, 0.0)), (1.0, 0.0, 0.0), atol=0.1)
