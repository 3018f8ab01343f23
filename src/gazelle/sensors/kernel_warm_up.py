"""Loading the kernels ahead of the first picture."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from gazelle.description.model import Box, CameraSpec, Light, LightType, Link, Model, Visual, World
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["warm_up"]


def warm_up(progress: Callable[[str], None] | None = None) -> float:
    """Load the cameras' kernels, compiling them if this machine has not done so yet.

    Args:
        progress: told in a sentence when compiling starts and when it is done; silent when the
            kernels come from the cache (which takes about 0.4 s).

    Returns:
        seconds it took.

    Raises:
        EmbreeError: Embree cannot be loaded.
    """
    started = time.perf_counter()
    from numba.core import event

    told: list[bool] = []

    class CompileListener(event.Listener):  # type: ignore[misc]
        """Hears from numba of what was not in its cache."""

        def on_start(self, event: Any) -> None:
            if progress is not None and not told:
                progress("compiling camera kernels: a few seconds, once on this machine")
            told.append(True)

        def on_end(self, event: Any) -> None:
            """Wait for the last one before saying so."""

    with event.install_listener("numba:compile", CompileListener()):
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
