"""How long sensors take: scans, pictures, clouds, moving things, loading kernels.

    python benchmarks/bench_sensors.py

Times are medians in milliseconds of this process's wall clock and of its processor time (all
threads). The scene is of our making: 60 boxes, cylinders, spheres and meshes on a textured floor,
about 250,000 triangles, one sun with shadows.
"""

from __future__ import annotations

import math
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from gazelle.description.model import (
    Box,
    CameraSpec,
    Cylinder,
    LidarSpec,
    Light,
    LightType,
    Link,
    Material,
    MeshShape,
    Model,
    Noise,
    Plane,
    Scene,
    Shape,
    Sphere,
    Visual,
    World,
)
from gazelle.geometry import Pose
from gazelle.sensors import (
    RayScene,
    camera_intrinsics,
    noise_stream,
    point_cloud,
    render,
    scan,
    warm_up,
)

REPEATS = 30
THINGS = 60


@dataclass(frozen=True)
class Poses:
    """A snapshot as the engine makes them."""

    link_names: tuple[str, ...]
    T: np.ndarray


def main() -> None:
    """Print one line per measurement."""
    _print_start()
    with tempfile.TemporaryDirectory() as folder:
        scene, poses = _scene(Path(folder))
        _print_scans(scene, poses)
        _print_pictures(scene)


def _print_start() -> None:
    code = "import time; t = time.perf_counter(); {}; print(time.perf_counter() - t)"
    for name, work in (
        ("import gazelle.sensors", "import gazelle.sensors"),
        ("  + warm_up(), cached", "from gazelle.sensors import warm_up; warm_up()"),
    ):
        runs = []
        for _ in range(4):
            command = [sys.executable, "-c", code.format(work)]
            runs.append(float(subprocess.run(command, check=True, capture_output=True).stdout))
        print(f"{name:44s} {1e3 * statistics.median(runs[1:]):8.2f} ms")
    warm_up(print)


def _print_scans(scene: RayScene, poses: Poses) -> None:
    spec = LidarSpec(
        samples=360, min_angle_rad=-3.0, max_angle_rad=3.0, range_min_m=0.1, range_max_m=30.0
    )
    noise = noise_stream(Noise("gaussian", stddev=0.01), 1, "laser")
    above = Pose((0.0, 0.0, 0.6))
    _measure("scan, 360 rays", lambda: scan(scene, spec, above))
    _measure("scan, 360 rays, noise", lambda: scan(scene, spec, above, noise=noise))
    tall = LidarSpec(
        samples=1875,
        min_angle_rad=-math.pi,
        max_angle_rad=math.pi,
        vertical_samples=16,
        vertical_min_angle_rad=-0.26,
        vertical_max_angle_rad=0.26,
        range_max_m=100.0,
    )
    _measure("scan, 16 × 1875 rays", lambda: scan(scene, tall, above))
    moved = poses.T.copy()

    def update() -> None:
        moved[:20, 2] += 1e-4
        scene.update(Poses(poses.link_names, moved))

    _measure("update, 20 of 60 links moved", update)
    _measure("update, nothing moved", lambda: scene.update(Poses(poses.link_names, moved)))


def _print_pictures(scene: RayScene) -> None:
    spec = CameraSpec(width_px=640, height_px=480, horizontal_fov_rad=1.05, near_m=0.05, far_m=50)
    eye = Pose.from_xyz_rpy((-7.0, -3.0, 2.5), (0.0, 0.3, 0.4))
    lens = camera_intrinsics(spec)
    for threads in (1, 2):

        def picture(threads: int = threads, **wanted: bool) -> None:
            render(scene, spec, eye, threads=threads, **wanted)

        def cloud(threads: int = threads) -> None:
            record = render(scene, spec, eye, want_depth=True, threads=threads)
            assert record.depth_m is not None
            point_cloud(record.depth_m, record.rgb, lens, near_m=0.4, threads=threads)

        name = f"640×480, {threads} thread{'s' * (threads > 1)}"
        _measure(f"{name}: RGB + depth + shadows", lambda: picture(want_depth=True))
        _measure(f"{name}: RGB + depth + cloud", cloud)
        _measure(
            f"{name}: RGB + depth, anti-aliased", lambda: picture(want_depth=True, antialias=True)
        )
        _measure(f"{name}: depth", lambda: picture(want_rgb=False, want_depth=True))


def _measure(name: str, work: Callable[[], object]) -> None:
    work()
    wall, processor = [], []
    for _ in range(REPEATS):
        cpu, clock = time.process_time(), time.perf_counter()
        work()
        wall.append(time.perf_counter() - clock)
        processor.append(time.process_time() - cpu)
    print(
        f"{name:44s} {1e3 * statistics.median(wall):8.2f} ms"
        f" {1e3 * statistics.median(processor):8.2f} ms CPU",
        flush=True,
    )


def _scene(folder: Path) -> tuple[RayScene, Poses]:
    random = np.random.default_rng(1)
    image, mesh = folder / "floor.png", folder / "bumps.stl"
    Image.fromarray(random.integers(90, 255, (512, 512, 3), np.uint8)).save(image)
    _write_bumps(mesh, 250)
    shapes: tuple[Shape, ...] = (
        Box((0.6, 0.5, 0.8)),
        Cylinder(0.3, 1.0),
        Sphere(0.4),
        MeshShape("bumps.stl", mesh),
    )
    links, rows = [], []
    for number in range(THINGS):
        x, y = random.uniform(-6, 6, 2)
        colour = (*random.uniform(0.3, 1.0, 3).tolist(), 1.0)
        paint = Material(ambient=colour, diffuse=colour, specular=(0.2, 0.2, 0.2, 1), shininess=20)
        visual = Visual("v", shapes[number % 4], material=paint)
        links.append(Link(f"thing{number}", Pose((x, y, 0.5)), visuals=(visual,)))
        rows.append([x, y, 0.5, 0.0, 0.0, 0.0, 1.0])
    floor = Material(diffuse=(1, 1, 1, 1), texture=image, texture_scale=(8.0, 8.0))
    ground = Visual("v", Plane(size_m=(40.0, 40.0)), material=floor, cast_shadows=False)
    links.append(Link("ground", visuals=(ground,)))
    sun = Light("sun", LightType.DIRECTIONAL, direction=(-0.5, 0.1, -0.9), cast_shadows=True)
    world = World(models=(Model("m", links=tuple(links)),), lights=(sun,), scene=Scene(sky=True))
    names = tuple(f"m::thing{number}" for number in range(THINGS))
    return RayScene(world), Poses(names, np.array(rows))


def _write_bumps(file: Path, cells: int) -> None:
    """Write a ball with waves as a binary STL of 2 · cells² triangles."""
    u, v = np.meshgrid(np.linspace(0, 2 * math.pi, cells + 1), np.linspace(0, math.pi, cells + 1))
    radius = 0.4 + 0.02 * np.sin(20 * u) * np.sin(20 * v)
    grid = radius[..., None] * np.stack(
        [np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)], -1
    )
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    corners = np.concatenate([np.stack([a, b, c], 2), np.stack([a, c, d], 2)]).reshape(-1, 3, 3)
    rows = np.zeros(
        len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("pad", "<u2")]
    )
    rows["corners"] = corners
    file.write_bytes(b" " * 80 + struct.pack("<I", len(rows)) + rows.tobytes())


if __name__ == "__main__":
    main()
