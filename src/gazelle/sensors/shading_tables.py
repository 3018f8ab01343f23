"""A ray scene's materials, textures, lights and background as plain arrays for the kernels."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Light, LightType, Material, Scene
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.images import PictureError, opened_picture
from gazelle.geometry import MeshMaterial
from gazelle.sensors.ray_scene import Instance, PlacedLight, RayScene
from gazelle.sensors.ray_surfaces import Surface, SurfacePart

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = [
    "LEVELS",
    "ShadingTables",
    "TextureAtlas",
    "background_colours",
    "light_table",
    "normal_matrices",
    "shading_tables",
]


_SKY = (
    # sine of the elevation; red, green, blue in 0…255
    (-1.000, (150, 150, 135)),
    (-0.200, (170, 170, 155)),
    (-0.127, (180, 182, 169)),
    (-0.095, (186, 191, 185)),
    (-0.064, (189, 196, 199)),
    (0.000, (189, 199, 217)),
    (0.062, (182, 195, 223)),
    (0.125, (173, 188, 224)),
    (0.185, (163, 179, 222)),
    (0.244, (153, 169, 217)),
    (0.300, (143, 160, 212)),
    (0.354, (135, 152, 207)),
    (0.600, (105, 122, 190)),
    (1.000, (78, 96, 172)),
)


_SKY_ROWS = 257
LEVELS = 13
_MAX_PX = 1 << (LEVELS - 1)
_LIGHT_TYPES = {LightType.DIRECTIONAL: 0.0, LightType.POINT: 1.0, LightType.SPOT: 2.0}
_LIGHT_COLUMNS, _MATERIAL_COLUMNS = 21, 16
_DEFAULT_MATERIAL = MeshMaterial(shininess=0.0)


@dataclass(frozen=True, slots=True, eq=False)
class ShadingTables:
    """What does not change while things move; see `kernels` for the columns.

    Attributes:
        revision: the scene's, when the tables were made.
        instance_part: (I,) int32, first row of `part_table` of each instance.
        part_table: (P, 3) int32: first face (−1 for spheres), first vertex, material.
        part_density: (P,) float32 texels per metre of surface.
        faces: (F, 3) int32 vertices of all distinct surfaces, one after the other.
        normals: (V, 3) float32 of their vertices, in the surface's frame.
        uv: (V, 2) float32 of their vertices.
        materials: (M, 16) float32.
        material_texture: (M,) int32, −1 for none.
        material_lit: (M,) bool.
        texels, levels, level_count: (n,), (T, levels, 3) and (T,); see `TextureAtlas.packed`.
        ambient: (3,) float32 of the scene.
        background: (rows, 3) float32.
    """

    revision: int
    instance_part: NDArray[np.int32]
    part_table: NDArray[np.int32]
    part_density: NDArray[np.float32]
    faces: NDArray[np.int32]
    normals: NDArray[np.float32]
    uv: NDArray[np.float32]
    materials: NDArray[np.float32]
    material_texture: NDArray[np.int32]
    material_lit: NDArray[np.bool_]
    texels: NDArray[np.uint8]
    levels: NDArray[np.int64]
    level_count: NDArray[np.int64]
    ambient: NDArray[np.float32]
    background: NDArray[np.float32]


def shading_tables(scene: RayScene) -> ShadingTables:
    """Collect geometry, materials and textures of a scene; unreadable textures are reported."""
    looks = _Looks(TextureAtlas(scene.diagnostics), [], [], [], [], [], [])
    offsets, arrays = _geometry(scene)
    for instance in scene.instances:
        looks.starts.append(len(looks.parts))
        for number, part in enumerate(instance.surface.parts):
            material = _add_material(looks, instance, part)
            looks.parts.append((*offsets[instance.surface, number], material))
            looks.density.append(_density(looks, instance, part, material))
    texels, levels, level_count = looks.atlas.packed()
    return ShadingTables(
        scene.revision,
        np.array(looks.starts, np.int32),
        np.array(looks.parts, np.int32).reshape(-1, 3),
        np.array(looks.density, np.float32),
        *arrays,
        np.array(looks.materials, np.float32).reshape(-1, _MATERIAL_COLUMNS),
        np.array(looks.textures, np.int32),
        np.array(looks.lit, bool),
        texels,
        levels,
        level_count,
        np.array(scene.world.scene.ambient[:3], np.float32),
        background_colours(scene.world.scene),
    )


def normal_matrices(scene: RayScene) -> NDArray[np.float32]:
    """Return (I, 3, 3) matrices that take each surface's normals to the world (any length).

    They are the cofactors of the linear part: the inverse transpose times the determinant.
    """
    a, b, c = (scene.T_world_surface[:, :3, column] for column in range(3))
    cofactors = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=2)
    size = np.abs(cofactors).max(axis=(1, 2), keepdims=True)
    return np.ascontiguousarray(cofactors / np.where(size > 0, size, 1), np.float32)


def light_table(lights: tuple[PlacedLight, ...], *, shadows: bool) -> NDArray[np.float32]:
    """Return (L, 21) float32 rows for the kernels, in world coordinates."""
    rows = np.zeros((len(lights), _LIGHT_COLUMNS), np.float32)
    for row, placed in zip(rows, lights, strict=True):
        light = placed.light
        direction = np.asarray(placed.T_world_light.rotate(light.direction))
        length = float(np.linalg.norm(direction))
        row[0] = _LIGHT_TYPES[light.type]
        row[1:4] = placed.T_world_light.position_m
        row[4:7] = direction / length if length > 0 else (0, 0, -1)
        row[7:10] = np.multiply(light.diffuse[:3], light.intensity)
        row[10:13] = np.multiply(light.specular[:3], light.intensity)
        row[13] = light.range_m
        row[14:17] = _attenuation(light)
        row[17] = math.cos(light.spot_inner_angle_rad / 2)
        row[18] = math.cos(light.spot_outer_angle_rad / 2)
        row[19] = light.spot_falloff
        row[20] = shadows and light.cast_shadows
    return rows


def background_colours(scene: Scene) -> NDArray[np.float32]:
    """Return the background from straight down to straight up, (rows, 3) float32 in 0…1.

    Rows are equal steps of the sine of the elevation. Without a sky there is one row: the
    scene's background colour. The sky is cloudless, in the mean colours over all azimuths that
    recorded pictures of Gazebo Classic's default sky show.
    """
    if not scene.sky:
        return np.array([scene.background[:3]], np.float32)
    heights = np.linspace(-1.0, 1.0, _SKY_ROWS)
    known = [height for height, _ in _SKY]
    channels = [
        np.interp(heights, known, [colour[channel] / 255.0 for _, colour in _SKY])
        for channel in range(3)
    ]
    return np.ascontiguousarray(np.stack(channels, axis=1), np.float32)


class TextureAtlas:
    """Collects textures and lays them out one after the other.

    Attributes:
        diagnostics: told about images that cannot be read.
    """

    def __init__(self, diagnostics: Diagnostics) -> None:
        self.diagnostics = diagnostics
        self._numbers: dict[object, int] = {}
        self._chains: list[list[NDArray[np.uint8]]] = []

    def add(self, source: Path | bytes | None) -> int:
        """Return a texture's number, -1 for none or one that cannot be read."""
        if source is None:
            return -1
        if source not in self._numbers:
            pixels = self._read(source)
            self._numbers[source] = -1 if pixels is None else len(self._chains)
            if pixels is not None:
                self._chains.append(_reduced_copies(pixels))
        return self._numbers[source]

    def width_px(self, number: int) -> int:
        """Return a texture's full width."""
        return int(self._chains[number][0].shape[1])

    def packed(
        self,
    ) -> tuple[NDArray[np.uint8], NDArray[np.int64], NDArray[np.int64]]:
        """Return texels, (T, LEVELS, 3) offset, width, height of each level, (T,) counts."""
        levels = np.zeros((max(1, len(self._chains)), LEVELS, 3), np.int64)
        counts = np.ones(max(1, len(self._chains)), np.int64)
        offset = 0
        for number, chain in enumerate(self._chains):
            counts[number] = len(chain)
            for level, pixels in enumerate(chain):
                levels[number, level] = (offset, pixels.shape[1], pixels.shape[0])
                offset += pixels.size
        flat = [pixels.ravel() for chain in self._chains for pixels in chain]
        return np.concatenate(flat) if flat else np.zeros(12, np.uint8), levels, counts

    def _read(self, source: Path | bytes) -> NDArray[np.uint8] | None:
        try:
            with opened_picture(source) as image:
                return np.asarray(_power_of_two(image.convert("RGB")))
        except (OSError, PictureError) as error:
            name = "embedded in a mesh" if isinstance(source, bytes) else f"'{source}'"
            span = None if isinstance(source, bytes) else SourceSpan(str(source))
            self.diagnostics.report(
                "sensors.unreadable-texture",
                f"texture {name} cannot be read ({error}); the plain colour is shown",
                span,
            )
            return None


def _power_of_two(image: Image) -> Image:
    from PIL.Image import Resampling

    sides = [min(_MAX_PX, 1 << (side - 1).bit_length()) for side in image.size]
    size = (sides[0], sides[1])
    return image if image.size == size else image.resize(size, Resampling.BICUBIC)


def _reduced_copies(pixels: NDArray[np.uint8]) -> list[NDArray[np.uint8]]:
    chain = [np.ascontiguousarray(pixels)]
    exact: NDArray[np.floating] = pixels.astype(np.float32)
    while max(exact.shape[:2]) > 1:
        if exact.shape[0] > 1:
            exact = (exact[0::2] + exact[1::2]) / 2
        if exact.shape[1] > 1:
            exact = (exact[:, 0::2] + exact[:, 1::2]) / 2
        chain.append(np.round(exact).astype(np.uint8))
    return chain


@dataclass(slots=True)
class _Looks:
    """Rows collected while going over the instances."""

    atlas: TextureAtlas
    materials: list[list[float]]
    textures: list[int]
    lit: list[bool]
    parts: list[tuple[int, int, int]]
    density: list[float]
    starts: list[int]


def _attenuation(light: Light) -> tuple[float, float, float]:
    factors = (
        light.attenuation_constant,
        light.attenuation_linear,
        light.attenuation_quadratic,
    )
    return factors if any(factor > 0 for factor in factors) else (1.0, 0.0, 0.0)


def _geometry(
    scene: RayScene,
) -> tuple[
    dict[tuple[Surface, int], tuple[int, int]],
    tuple[NDArray[np.int32], NDArray[np.float32], NDArray[np.float32]],
]:
    """Return where each distinct part starts (face, vertex), and all faces, normals and uv."""
    offsets: dict[tuple[Surface, int], tuple[int, int]] = {}
    faces = [np.zeros((0, 3), np.int32)]
    normals = [np.zeros((0, 3), np.float32)]
    uv = [np.zeros((0, 2), np.float32)]
    face_count = vertex_count = 0
    for surface in dict.fromkeys(instance.surface for instance in scene.instances):
        for number, part in enumerate(surface.parts):
            if part.facets is None:
                offsets[surface, number] = (-1, 0)
                continue
            offsets[surface, number] = (face_count, vertex_count)
            faces.append(part.facets.faces)
            normals.append(part.facets.normals)
            uv.append(part.facets.uv)
            face_count += len(part.facets.faces)
            vertex_count += len(part.facets.normals)
    return offsets, (np.concatenate(faces), np.concatenate(normals), np.concatenate(uv))


def _add_material(looks: _Looks, instance: Instance, part: SurfacePart) -> int:
    chosen: Material | MeshMaterial = instance.material or part.material or _DEFAULT_MATERIAL
    script = chosen if isinstance(chosen, Material) else None
    opacity = min(1.0, max(0.0, chosen.diffuse[3] * instance.opacity))
    looks.materials.append(
        [
            *chosen.ambient[:3],
            *chosen.diffuse[:3],
            *chosen.emissive[:3],
            *chosen.specular[:3],
            chosen.shininess,
            opacity,
            *(script.texture_scale if script else (1.0, 1.0)),
        ]
    )
    looks.textures.append(looks.atlas.add(chosen.texture))
    looks.lit.append(script.lighting if script else True)
    return len(looks.materials) - 1


def _density(looks: _Looks, instance: Instance, part: SurfacePart, material: int) -> float:
    """Texels per metre, from the middle one of the edges' ratios."""
    texture = looks.textures[material]
    if texture < 0 or part.facets is None:
        return 1.0
    facets, scale = part.facets, instance.T_link_surface[:3, :3]
    first, second = facets.faces[:, 0], facets.faces[:, 1]
    edges = np.linalg.norm((facets.vertices[second] - facets.vertices[first]) @ scale.T, axis=1)
    repeats = np.array(looks.materials[material][14:16])
    spread = np.linalg.norm((facets.uv[second] - facets.uv[first]) * repeats, axis=1)
    usable = (edges > 1e-9) & (spread > 0)
    if not usable.any():
        return 1.0
    return float(np.median(spread[usable] / edges[usable])) * looks.atlas.width_px(texture)
