"""Methods and streams of the panel MotionPlanning."""

from __future__ import annotations

from gazelle.studio.motion.meshes import read_mesh
from gazelle.studio.motion.paths import open_path
from gazelle.studio.motion.planning_scene import open_scene
from gazelle.studio.motion.robot import get_motion_robot
from gazelle.studio.routing import Method, methods_without
from gazelle.studio.scenes.robot import RobotContext
from gazelle.studio.streams import StreamKind
from gazelle.studio.subscriptions import Taps

__all__ = ["METHODS", "STREAMS"]

METHODS: dict[str, Method[RobotContext]] = {
    **methods_without({"motion.mesh": read_mesh}),
    "motion.robot": get_motion_robot,
}
STREAMS: dict[str, StreamKind[Taps]] = {
    "motion.path": StreamKind(latest=True, open=open_path),
    "motion.scene": StreamKind(latest=True, open=open_scene),
}
