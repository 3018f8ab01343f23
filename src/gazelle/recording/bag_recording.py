"""A bag as a recording: the robot stands where the bag's tf has its links."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.bag import open_bag
from gazelle.bag.export import reader_of
from gazelle.bag.storage import BagError, BagReader
from gazelle.bag.types import bag_types, wire_name_of
from gazelle.description.loader import load_models
from gazelle.description.model import Link, Material, Model, Plane, Visual, World
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.interfaces.poses import pose_of_transform
from gazelle.recording.recording import Recording
from gazelle.recording.tape import Known, Tape, is_recorded
from gazelle.workspace import Workspace

__all__ = ["bag_recording"]

_PERIOD_NS = 40_000_000
_GROUND_M = 100.0
_TF = ("/tf", "/tf_static")
_FIXED = ("map", "odom")
_GREY = Material("Gazebo/Grey", ambient=(0.6, 0.6, 0.6, 1.0), diffuse=(0.7, 0.7, 0.7, 1.0))


def bag_recording(
    path: Path | str,
    *,
    robot: str | None = None,
    workspace: Workspace | None = None,
    diagnostics: Diagnostics | None = None,
) -> Recording:
    """Return what a bag holds as a recording: a robot on a ground, and the bag's topics.

    Links stand where tf has them in ``map``, ``odom`` or tf's root, each as it was last told; those
    that tf does not name stay where they are on their parents.

    Args:
        path: a bag of any format, or a folder of rosbag2.
        robot: URDF, xacro or SDF file; the bag's ``robot_description`` when None.
        workspace: finds packages and meshes; made from the environment when None.
        diagnostics: receives what was found about the robot.

    Raises:
        BagError: the bag cannot be read, or holds no tf or no robot.
        UserFileError: the robot's file has errors.
    """
    found = Diagnostics() if diagnostics is None else diagnostics
    bag = open_bag(path)
    try:
        messages = list(_messages(bag, found))
    finally:
        bag.close()
    source = robot or _description(messages)
    if source is None:
        raise BagError(
            f"{path}: the bag holds no robot_description\n"
            "  fix: name the robot's file: --robot FILE.urdf"
        )
    models = load_models(
        source, workspace=workspace or Workspace.discover(), diagnostics=found, inserts=False
    )
    found.raise_if_errors()
    tape = Tape()
    world = World(name=Path(path).stem, models=(_ground(), *models))
    names = tuple(f"{model.name}::{link.name}" for model in world.models for link in model.links)
    tape.know(0, Known(lambda: world, names))
    _write(tape, models, messages)
    recording = tape.recording()
    if recording is None:
        raise BagError(
            f"{path}: the bag holds no tf, which says where the robot is\n"
            "  fix: record /tf and /tf_static too, e.g. rosbag record -a"
        )
    return recording


_Message = tuple[int, str, str, Any]
"""Time in ns, topic, type, and the message."""


def _messages(bag: BagReader, diagnostics: Diagnostics) -> Iterator[_Message]:
    types = bag_types(bag.connections).store
    wanted = [one for one in bag.connections if is_recorded(one.topic, wire_name_of(one), None)]
    readers = {}
    for one in wanted:
        try:
            readers[one.topic] = (wire_name_of(one), reader_of(one, types))
        except GazelleError as error:
            text = f"topic {one.topic} ({one.type_name}) is left out: {error}"
            diagnostics.report("bag.not-converted", text)
    for item in bag.messages(lambda one: one.topic in readers):
        type_name, read = readers[item.connection.topic]
        yield item.stamp_ns, item.connection.topic, type_name, read(item.data)


def _description(messages: list[_Message]) -> str | None:
    for _, topic, _, message in messages:
        if topic.endswith("robot_description"):
            return str(message.data)
    return None


def _ground() -> Model:
    plane = Visual("ground", Plane(size_m=(_GROUND_M, _GROUND_M)), material=_GREY)
    return Model("ground", static=True, links=(Link("link", visuals=(plane,)),))


def _write(tape: Tape, models: tuple[Model, ...], messages: list[_Message]) -> None:
    parents: dict[str, tuple[str, Pose]] = {}
    links = {link.name for model in models for link in model.links}
    next_ns = last_ns = 0
    is_there = False
    for time_ns, topic, type_name, message in messages:
        tape.add_message(topic, type_name, time_ns, message)
        if topic in _TF:
            for one in message.transforms:
                child, parent = one.child_frame_id.strip("/"), one.header.frame_id.strip("/")
                parents[child] = (parent, pose_of_transform(one.transform))
                is_there |= child.rpartition("/")[2] in links
        last_ns = time_ns
        if is_there and time_ns >= next_ns:
            tape.add_moment(0, time_ns, _poses(models, parents))
            next_ns = time_ns + _PERIOD_NS
    if is_there:
        tape.add_moment(0, last_ns, _poses(models, parents))


def _poses(models: tuple[Model, ...], parents: dict[str, tuple[str, Pose]]) -> NDArray[np.float64]:
    frames = set(parents) | {parent for parent, _ in parents.values()}
    fixed = next((name for name in _FIXED if name in frames), "")
    T_fixed_root = _climbed(fixed, parents).inverse() if fixed else IDENTITY_POSE
    rows = [IDENTITY_POSE]
    for model in models:
        placed: dict[str, Pose] = {}
        joints = {joint.child: joint.parent for joint in model.joints}
        for link in model.links:
            placed[link.name] = _placed(link, model, joints, frames, parents, placed)
        rows += [T_fixed_root @ placed[link.name] for link in model.links]
    return np.array([[*one.position_m, *one.quat_xyzw] for one in rows])


def _placed(
    link: Link,
    model: Model,
    joints: dict[str, str],
    frames: set[str],
    parents: dict[str, tuple[str, Pose]],
    placed: dict[str, Pose],
) -> Pose:
    """Return a link's pose in tf's root: by tf, else by its parent in the description."""
    ending = f"/{link.name}"
    frame = link.name if link.name in frames else next(
        (one for one in frames if one.endswith(ending)), ""
    )  # fmt: skip
    if frame:
        return _climbed(frame, parents)
    parent = model.link(joints.get(link.name, ""))
    if parent is None:
        return link.T_model_link
    known = placed.get(parent.name)
    if known is None:
        known = _placed(parent, model, joints, frames, parents, placed)
    return known @ parent.T_model_link.inverse() @ link.T_model_link


def _climbed(frame: str, parents: dict[str, tuple[str, Pose]]) -> Pose:
    """Return ``T_root_frame``."""
    pose = IDENTITY_POSE
    for _ in range(len(parents) + 1):
        if frame not in parents:
            break
        frame, T_parent_child = parents[frame]
        pose = T_parent_child @ pose
    return pose
