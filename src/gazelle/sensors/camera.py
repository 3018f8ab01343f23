"""Cameras: a picture, its depth, or both in one pass."""

from __future__ import annotations

import math
import weakref
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec
from gazelle.geometry import Pose
from gazelle.noise import PictureNoise
from gazelle.rich_display import shown_by
from gazelle.sensors.camera_kernel_arguments import Lighting, Output, Packet, Surfaces, View
from gazelle.sensors.distortion import distort, is_distorting
from gazelle.sensors.embree import packet_buffer
from gazelle.sensors.intrinsics import camera_intrinsics
from gazelle.sensors.ray_scene import SHADOW_BIT, RayScene
from gazelle.sensors.row_threads import default_threads, each_band, row_bands
from gazelle.sensors.shading_tables import (
    ShadingTables,
    light_table,
    normal_matrices,
    shading_tables,
)

__all__ = ["CameraRecord", "render"]

_EDGE_STEP = 24
"""Steps of colour (of 255) between neighbours that are smoothed by anti-aliasing."""

_COHERENT = 1 << 16
_ALL_FEATURES = 0xFFFFFFFF


@shown_by("cameras:camera_bundle")
@dataclass(frozen=True, slots=True, eq=False)
class CameraRecord:
    """One exposure.

    Attributes:
        rgb: (H, W, 3) uint8, or None when it was not wanted.
        depth_m: (H, W) float32, distance along the viewing axis, inf where nothing is met between
            the clip distances; or None.
    """

    rgb: NDArray[np.uint8] | None
    depth_m: NDArray[np.float32] | None


def render(
    scene: RayScene,
    spec: CameraSpec,
    T_world_camera: Pose,
    *,
    want_rgb: bool = True,
    want_depth: bool = False,
    antialias: bool = False,
    noise: PictureNoise | None = None,
    threads: int | None = None,
) -> CameraRecord:
    """Render what a camera sees; the result does not depend on the number of threads.

    The camera looks along +x of its frame, y left, z up. Colours follow OGRE's classic lighting,
    as Gazebo Classic shows them: ``ambient · scene ambient + emissive + Σ light · diffuse · cos``
    times the texture, plus Blinn–Phong highlights; shadows are exact. Lens distortion and noise
    go on the picture, not on the depth (as in Gazebo). Noise is one sample per pixel for all
    three channels, its unit the full brightness.

    Args:
        scene: visuals, updated to the moment of the exposure.
        spec: the camera; `T_sensor_camera` is the caller's to apply.
        T_world_camera: the camera's frame.
        want_rgb: render the picture.
        want_depth: render the depth.
        antialias: render tiles that contain edges again with 2×2 samples per pixel.
        noise: None for a clean picture.
        threads: None for `default_threads`.

    Raises:
        EmbreeError: Embree cannot be loaded.
    """
    rgb = np.empty((spec.height_px, spec.width_px, 3), np.uint8) if want_rgb else None
    depth = np.empty((spec.height_px, spec.width_px), np.float32) if want_depth else None
    if not (want_rgb or want_depth):
        return CameraRecord(None, None)
    if spec.kind == "wideangle":
        _report_lens(scene, spec)
    with scene.lock:
        exposure = _Exposure(scene, spec, T_world_camera, rgb, depth)
        exposure.run(default_threads() if threads is None else threads, antialias)
    if rgb is not None and spec.distortion is not None and is_distorting(spec.distortion):
        rgb = distort(rgb, spec.distortion)
    if rgb is not None and noise is not None:
        rgb = noise.apply(rgb)
    return CameraRecord(rgb, depth)


_tables: weakref.WeakKeyDictionary[RayScene, ShadingTables] = weakref.WeakKeyDictionary()


def _tables_of(scene: RayScene) -> ShadingTables:
    tables = _tables.get(scene)
    if tables is None or tables.revision != scene.revision:
        tables = _tables[scene] = shading_tables(scene)
    return tables


class _Exposure:
    """Everything one picture needs, and the bands it is rendered in."""

    def __init__(
        self,
        scene: RayScene,
        spec: CameraSpec,
        T_world_camera: Pose,
        rgb: NDArray[np.uint8] | None,
        depth: NDArray[np.float32] | None,
    ) -> None:
        lens = camera_intrinsics(spec)
        tables = _tables_of(scene)
        shadows = scene.world.scene.shadows
        height, width = lens.height, lens.width
        self.tiles = np.ones((-(-height // 4), -(-width // 4)), np.uint8)
        self.rgb, self.depth = rgb, depth
        self._scene, self._rows = scene.handle, height
        self._view = View(
            np.array(T_world_camera.position_m, np.float32),
            T_world_camera.matrix()[:3, :3].astype(np.float32),
            np.array([lens.fx, lens.fy, lens.cx, lens.cy, lens.skew], np.float32),
            np.array([spec.near_m, spec.far_m], np.float32),
            np.int32(spec.visibility_mask & ~SHADOW_BIT),
        )
        self._surfaces = Surfaces(
            tables.instance_part,
            normal_matrices(scene),
            tables.part_table,
            tables.part_density,
            tables.faces,
            tables.normals,
            tables.uv,
            tables.materials,
            tables.material_texture,
            tables.material_lit,
            tables.texels,
            tables.levels,
            tables.level_count,
        )
        lights = light_table(scene.lights(), shadows=shadows)
        self._lighting = Lighting(lights, tables.ambient, tables.background)
        self._arguments = np.zeros(16, np.uint32)
        self._arguments[:2] = _COHERENT, _ALL_FEATURES

    def run(self, threads: int, antialias: bool) -> None:
        from gazelle.sensors.pixel_kernels import mark_edges

        self._all_bands(threads, 1)
        if antialias and self.rgb is not None:
            rgb, tiles = self.rgb, self.tiles
            each_band(
                threads,
                row_bands(self._rows, threads, multiple=4),
                lambda first, last: mark_edges(rgb, tiles, first, last, _EDGE_STEP),
            )
            self._all_bands(threads, 2)

    def _all_bands(self, threads: int, samples: int) -> None:
        from gazelle.sensors.camera_kernels import SCRATCH_ROWS, render_rows

        want_rgb, want_depth = self.rgb is not None, self.depth is not None
        rgb = np.empty((1, 1, 3), np.uint8) if self.rgb is None else self.rgb
        depth = np.empty((1, 1), np.float32) if self.depth is None else self.depth
        arguments = self._arguments.ctypes.data
        output = Output(self.tiles, want_rgb, rgb, want_depth, depth)

        def band(first: int, last: int) -> None:
            floats = packet_buffer(SCRATCH_ROWS // 24).reshape(-1)
            packet = Packet(floats.view(np.int32), floats, floats.ctypes.data, arguments)
            render_rows(
                self._scene,
                (first, last),
                self._view,
                self._surfaces,
                self._lighting,
                packet,
                samples,
                output,
            )

        each_band(threads, row_bands(self._rows, threads, multiple=4), band)


def _report_lens(scene: RayScene, spec: CameraSpec) -> None:
    degrees = math.degrees(spec.horizontal_fov_rad)
    text = f"camera '{spec.name}' has a wide-angle lens of {degrees:.0f} degrees; it is drawn as a"
    scene.diagnostics.report("sensors.wide-angle-lens", f"{text} pinhole")
