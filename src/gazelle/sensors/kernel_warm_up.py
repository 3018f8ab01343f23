"""Loading the kernels ahead of the first picture."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import nullcontext

from gazelle.announcements import announced_by
from gazelle.description.model import Box, CameraSpec, Light, LightType, Link, Model, Visual, World
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["warm_up"]


def warm_up(progress: Callable[[str], None] | None = None) -> float:
    """Load the cameras' kernels, compiling them if this machine has not done so yet.

    Args:
        progress: told in a sentence when compiling starts and when it is done; silent when the
            kernels come from the cache. Without it who listens to this
            process is told that it starts.

    Returns:
        seconds it took.

    Raises:
        EmbreeError: Embree cannot be loaded.
    """
    started = time.perf_counter()
    told: list[str] = []

    def say(text: str) -> None:
        told.append(text)
        if progress is not None:
            progress(text)

    with nullcontext() if progress is None else announced_by(say):
        _exercise()
    seconds = time.perf_counter() - started
    if progress is not None and told:
        progress(f"camera kernels compiled in {seconds:.0f} s")
    return seconds


def _exercise() -> None:
    """Run every kernel once on the smallest scene, with the argument types of real use."""
    from gazelle.sensors.camera import render
    from gazelle.sensors.depth import point_cloud
    from gazelle.sensors.intrinsics import camera_intrinsics
    from gazelle.sensors.ray_scene import RayScene

    box = Visual("box", Box((1.0, 1.0, 1.0)), Pose((2.0, 0.0, 0.0)))
    link = Link("link", visuals=(box,))
    sun = Light("sun", LightType.DIRECTIONAL, cast_shadows=True)
    scene = RayScene(World(models=(Model("model", links=(link,)),), lights=(sun,)))
    spec = CameraSpec(width_px=8, height_px=8)
    record = render(scene, spec, IDENTITY_POSE, want_depth=True, antialias=True, threads=1)
    if record.depth_m is not None:
        point_cloud(record.depth_m, record.rgb, camera_intrinsics(spec), threads=1)
