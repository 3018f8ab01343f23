"""Methods and streams of the panel MotionPlanning; planned paths, and mesh files as messages."""

from __future__ import annotations

import base64
import binascii
import tempfile
from pathlib import Path
from typing import Any, TypedDict

import numpy as np

from gazelle.studio.errors import StudioError
from gazelle.studio.json_text import message_value
from gazelle.studio.motion.planning_scene import open_scene
from gazelle.studio.motion.robot import get_motion_robot
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method, methods_without
from gazelle.studio.scenes.robot import RobotContext
from gazelle.studio.streams import Channel, OpenStream, StreamKind
from gazelle.studio.subscriptions import Sample, Subscriptions

__all__ = ["METHODS", "STREAMS", "MotionMesh", "open_path", "read_mesh"]

_MAX_TRIANGLES = 200_000


def open_path(subscriptions: Subscriptions, channel: Channel, params: Params) -> OpenStream:
    """Send each ``moveit_msgs/DisplayTrajectory`` of a ``topic``."""

    def value(sample: Sample) -> Any:
        message: Any = sample.message()
        if not hasattr(message, "trajectory_start"):
            raise StudioError(f"{message.TYPE_NAME} is no moveit_msgs/DisplayTrajectory")
        return message_value(message, None)

    def take(sample: Sample) -> None:
        channel.offer(lambda: value(sample))

    return OpenStream(subscriptions.listen(params.text("topic"), take))


class MotionMesh(TypedDict):
    """A mesh as `shape_msgs/Mesh` has it, metres."""

    vertices: list[list[float]]
    triangles: list[list[int]]


def read_mesh(params: Params) -> MotionMesh:
    """Read the file ``name`` with the content ``base64``; vertices in metres."""
    # Readers of meshes are needed by few pages.
    from gazelle.errors import GazelleError
    from gazelle.geometry import MESH_SUFFIXES, load_mesh

    name = Path(params.text("name")).name
    if Path(name).suffix.lower() not in MESH_SUFFIXES:
        raise StudioError(f"{name} is no mesh file", known=MESH_SUFFIXES)
    try:
        data = base64.b64decode(params.text("base64"), validate=True)
    except binascii.Error as error:
        raise StudioError(f"{name}: its content is not base64: {error}") from error
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / name
        file.write_bytes(data)
        try:
            mesh = load_mesh(file, smooth=False)
        except GazelleError as error:
            raise StudioError(str(error).replace(f"{folder}/", "")) from error
    return _value(name, [(part.vertices_m, part.faces) for part in mesh.parts])


def _value(name: str, parts: list[tuple[Any, Any]]) -> MotionMesh:
    """Return one mesh; corners at the same place are one vertex."""
    begins = np.cumsum([0, *(len(vertices) for vertices, _ in parts[:-1])])
    corners = np.concatenate([np.asarray(vertices, np.float64) for vertices, _ in parts])
    faces = np.concatenate(
        [np.asarray(rows).reshape(-1, 3) + at for (_, rows), at in zip(parts, begins, strict=True)]
    )
    if len(faces) > _MAX_TRIANGLES:
        text = f"{name} has {len(faces)} triangles, more than {_MAX_TRIANGLES}"
        raise StudioError(text, hint="Planning needs a simple shape; reduce the mesh first.")
    vertices, index = np.unique(corners.round(9), axis=0, return_inverse=True)
    return {"vertices": vertices.tolist(), "triangles": index.reshape(-1)[faces].tolist()}


METHODS: dict[str, Method[RobotContext]] = {
    **methods_without({"motion.mesh": read_mesh}),
    "motion.robot": get_motion_robot,
}
STREAMS: dict[str, StreamKind[Subscriptions]] = {
    "motion.path": StreamKind(latest=True, open=open_path),
    "motion.scene": StreamKind(latest=True, open=open_scene),
}
