"""What the kernel that draws pictures is given, as records that it takes whole."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Lighting", "Output", "Packet", "Surfaces", "View"]

_Floats = NDArray[np.float32]
_Ints = NDArray[np.int32]


class View(NamedTuple):
    """A camera.

    Attributes:
        position_m: (3,) in the world.
        rotation: (3, 3), columns ahead, left, up in the world.
        lens: (5,) fx, fy, cx, cy, skew, pixels.
        clip_m: (2,) nearest and farthest.
        mask: of what is seen.
    """

    position_m: _Floats
    rotation: _Floats
    lens: _Floats
    clip_m: _Floats
    mask: np.int32


class Surfaces(NamedTuple):
    """What rays may meet; see `ShadingTables`, of which all but the second field are.

    Attributes:
        instance_part: (I,) first part of each instance.
        normal_matrix: (I, 3, 3) of each instance.
        part_table, part_density: (P, 3) and (P,), of each part.
        faces, normals, uv: (F, 3), (V, 3) and (V, 2), of all surfaces.
        materials, material_texture, material_lit: (M, 16), (M,) and (M,).
        texels, levels, level_count: (n,), (T, levels, 3) and (T,).
    """

    instance_part: NDArray[np.generic]
    normal_matrix: NDArray[np.generic]
    part_table: NDArray[np.generic]
    part_density: NDArray[np.generic]
    faces: NDArray[np.generic]
    normals: NDArray[np.generic]
    uv: NDArray[np.generic]
    materials: NDArray[np.generic]
    material_texture: NDArray[np.generic]
    material_lit: NDArray[np.generic]
    texels: NDArray[np.generic]
    levels: NDArray[np.generic]
    level_count: NDArray[np.generic]


class Lighting(NamedTuple):
    """Where light comes from.

    Attributes:
        lights: (n, columns), `LIGHT_COLUMNS` of them.
        ambient: (3,) rgb.
        background: (m, 3) rgb from the nadir to the zenith.
    """

    lights: _Floats
    ambient: _Floats
    background: _Floats


class Packet(NamedTuple):
    """Memory for a packet of rays, of one thread.

    Attributes:
        words: (`SCRATCH_ROWS`, 16).
        floats: (`SCRATCH_ROWS`, 16), the same memory.
        address: of it.
        arguments: address of Embree's RTCIntersectArguments.
    """

    words: _Ints
    floats: _Floats
    address: int
    arguments: int


class Output(NamedTuple):
    """What is drawn.

    Attributes:
        tiles: (rows / 4, columns / 4), 0 where nothing is to be drawn.
        want_rgb: whether there is a picture.
        rgb: (rows, columns, 3).
        want_depth: whether there are distances.
        depth_m: (rows, columns).
    """

    tiles: NDArray[np.uint8]
    want_rgb: bool
    rgb: NDArray[np.uint8]
    want_depth: bool
    depth_m: _Floats
