"""Methods and streams of the panel MotionPlanning."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.motion.meshes import read_mesh
from gazelle.studio.motion.paths import open_path
from gazelle.studio.motion.robot import get_motion_robot
from gazelle.studio.motion.scenes import open_scene
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import StreamKind

__all__ = ["METHODS", "STREAMS"]

METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "motion.mesh": read_mesh,
    "motion.robot": get_motion_robot,
}
STREAMS: dict[str, StreamKind] = {
    "motion.path": StreamKind(latest=True, open=open_path),
    "motion.scene": StreamKind(latest=True, open=open_scene),
}
