# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled inner loop of the cameras.

Importing this module loads Embree; only cameras do.

Rays travel in packets of 16, one 4×4 tile of pixels each. All memory the kernel touches is passed
in; it holds no Python object and releases the interpreter lock.
"""

from __future__ import annotations

import math

import llvmlite.binding
import numpy as np

from gazelle.kernels import External, kernel
from gazelle.sensors.embree import library

__all__ = [
    "LIGHT_COLUMNS",
    "MATERIAL_COLUMNS",
    "SCRATCH_ROWS",
    "render_rows",
]

# The symbols below are looked up by name when cached code is loaded.
llvmlite.binding.load_library_permanently(str(library().path))
_intersect16 = External("rtcIntersect16", 4)
_occluded16 = External("rtcOccluded16", 4)

SCRATCH_ROWS = 48
"""Rows of 16 words: 0–23 RTCRayHit16, 24–39 RTCRay16 of shadows, 40 and 41 their lanes."""

# Where Embree's RTCRayHit16 has what, in words: rows of 16, one for each ray of a packet.
_FROM, _NEAR, _ALONG, _FAR, _MASK = 0 * 16, 3 * 16, 4 * 16, 8 * 16, 9 * 16
_NORMAL, _U, _V, _FACE, _PART, _INSTANCE = 12 * 16, 15 * 16, 16 * 16, 17 * 16, 18 * 16, 19 * 16
_SHADOW, _LANES, _SHADOW_LANES = 24 * 16, 40 * 16, 41 * 16

MATERIAL_COLUMNS = 16
"""Ambient rgb, diffuse rgb, emissive rgb, specular rgb, shininess, opacity, texture scale u v."""

LIGHT_COLUMNS = 21
"""Type (0 directional, 1 point, 2 spot), position, direction of travel, diffuse rgb, specular
rgb, range, attenuation constant linear quadratic, cos of inner and outer half angle, falloff,
shadows (0 or 1)."""

_LAYERS = 4
"""Transparent surfaces looked through per pixel."""

_LOOSE = "reassoc contract arcp afn nsz"
"""Fast mathematics that still knows infinity and NaN."""

_ONE = np.float32(1.0)
_ZERO = np.float32(0.0)
_HALF = np.float32(0.5)


@kernel(flags=_LOOSE)
def _texel(texels, offset, width, height, u, v):
    """Bilinear look-up with wrapping; sides are powers of two, v points up."""
    x = u * width - _HALF
    y = (_ONE - v) * height - _HALF
    x_floor = math.floor(x)
    y_floor = math.floor(y)
    x0 = int(x_floor)
    y0 = int(y_floor)
    fx = np.float32(x - x_floor)
    fy = np.float32(y - y_floor)
    xa = x0 & (width - 1)
    xb = (x0 + 1) & (width - 1)
    ya = (y0 & (height - 1)) * width
    yb = ((y0 + 1) & (height - 1)) * width
    p = offset + (ya + xa) * 3
    q = offset + (ya + xb) * 3
    r = offset + (yb + xa) * 3
    s = offset + (yb + xb) * 3
    wp = (_ONE - fx) * (_ONE - fy)
    wq = fx * (_ONE - fy)
    wr = (_ONE - fx) * fy
    ws = fx * fy
    return (
        wp * texels[p] + wq * texels[q] + wr * texels[r] + ws * texels[s],
        wp * texels[p + 1] + wq * texels[q + 1] + wr * texels[r + 1] + ws * texels[s + 1],
        wp * texels[p + 2] + wq * texels[q + 2] + wr * texels[r + 2] + ws * texels[s + 2],
    )


@kernel(flags=_LOOSE)
def render_rows(scene, rows, view, surfaces, lighting, packet, samples, output):
    """Draw some rows of a picture.

    Args:
        scene: address of Embree's scene.
        rows: the first one and the one behind the last.
        view: a `View`.
        surfaces: `Surfaces`.
        lighting: a `Lighting`.
        packet: a `Packet`.
        samples: along each side of a pixel.
        output: an `Output`.
    """
    first_row, last_row = rows
    camera, rotation, lens, clip, mask = view
    instance_part, normal_matrix, part_table = (
        surfaces.instance_part,
        surfaces.normal_matrix,
        surfaces.part_table,
    )
    part_density, faces, normals = surfaces.part_density, surfaces.faces, surfaces.normals
    uv, materials = surfaces.uv, surfaces.materials
    material_texture, material_lit = surfaces.material_texture, surfaces.material_lit
    texels, levels, level_count = surfaces.texels, surfaces.levels, surfaces.level_count
    lights, ambient, background = lighting
    sky_rows = background.shape[0]
    words, floats, address, arguments = packet
    tiles, want_rgb, rgb, want_depth, depth = output
    if want_rgb:
        height = rgb.shape[0]
        width = rgb.shape[1]
    else:
        height = depth.shape[0]
        width = depth.shape[1]
    fx = lens[0]
    fy = lens[1]
    cx = lens[2]
    cy = lens[3]
    skew = lens[4]
    pixel_angle = _ONE / (fx * np.float32(samples))
    per_sample = _ONE / np.float32(samples * samples)
    total = np.zeros((16, 3), np.float32)
    through = np.zeros(16, np.float32)
    base = np.zeros((16, 3), np.float32)
    lit = np.zeros((16, 3), np.float32)
    shine = np.zeros((16, 3), np.float32)
    normal = np.zeros((16, 3), np.float32)
    towards = np.zeros((16, 3), np.float32)
    point = np.zeros((16, 3), np.float32)
    to_light = np.zeros((16, 3), np.float32)
    strength = np.zeros(16, np.float32)
    shown = np.zeros(16, np.int32)
    material_of = np.zeros(16, np.int32)
    shadow = _SHADOW
    valid_row = _LANES
    shadow_valid_row = _SHADOW_LANES
    light_count = lights.shape[0]
    # The rest of both rays (time, id, flags, a shadow's beginning) is zero and stays so.
    for j in range(16):
        floats[_FROM + j] = camera[0]
        floats[_FROM + 16 + j] = camera[1]
        floats[_FROM + 32 + j] = camera[2]
        words[_MASK + j] = mask
        words[shadow + _MASK + j] = -0x80000000
    for y in range(first_row, last_row, 4):
        for x in range(0, width, 4):
            if tiles[y >> 2, x >> 2] == 0:
                continue
            for j in range(16):
                total[j, 0] = _ZERO
                total[j, 1] = _ZERO
                total[j, 2] = _ZERO
            for sample in range(samples * samples):
                # Sample positions inside a pixel; one sample is its centre.
                ox = np.float32((sample % samples + 0.5) / samples - 0.5)
                oy = np.float32((sample // samples + 0.5) / samples - 0.5)
                for j in range(16):
                    px = np.float32(x + (j & 3)) + ox
                    py = np.float32(y + (j >> 2)) + oy
                    down = (py - cy) / fy
                    left = -(px - cx - skew * down) / fx
                    up = -down
                    floats[_NEAR + j] = clip[0]
                    floats[_ALONG + j] = (
                        rotation[0, 0] + rotation[0, 1] * left + rotation[0, 2] * up
                    )
                    floats[_ALONG + 16 + j] = (
                        rotation[1, 0] + rotation[1, 1] * left + rotation[1, 2] * up
                    )
                    floats[_ALONG + 32 + j] = (
                        rotation[2, 0] + rotation[2, 1] * left + rotation[2, 2] * up
                    )
                    floats[_FAR + j] = clip[1]
                    words[_PART + j] = -1
                    words[_INSTANCE + j] = -1
                    inside = x + (j & 3) < width and y + (j >> 2) < height
                    words[valid_row + j] = -1 if inside else 0
                    through[j] = per_sample if inside else _ZERO
                _intersect16(address + valid_row * 4, scene, address, arguments)
                if want_depth and sample == 0 and samples == 1:
                    for j in range(16):
                        if words[valid_row + j] != 0:
                            found = words[_PART + j] != -1
                            depth[y + (j >> 2), x + (j & 3)] = (
                                floats[_FAR + j] if found else np.float32(np.inf)
                            )
                if not want_rgb:
                    continue
                for layer in range(_LAYERS):
                    again = False
                    for j in range(16):
                        shown[j] = 0
                        if words[valid_row + j] == 0:
                            continue
                        dx = floats[_ALONG + j]
                        dy = floats[_ALONG + 16 + j]
                        dz = floats[_ALONG + 32 + j]
                        inverse_length = _ONE / math.sqrt(dx * dx + dy * dy + dz * dz)
                        if words[_PART + j] == -1:
                            row = (dz * inverse_length * _HALF + _HALF) * np.float32(sky_rows - 1)
                            low = min(int(row), sky_rows - 2) if sky_rows > 1 else 0
                            blend = row - np.float32(low) if sky_rows > 1 else _ZERO
                            high = low + 1 if sky_rows > 1 else 0
                            for c in range(3):
                                total[j, c] += through[j] * (
                                    background[low, c] * (_ONE - blend)
                                    + background[high, c] * blend
                                )
                            words[valid_row + j] = 0
                            continue
                        shown[j] = 1
                        t = floats[_FAR + j]
                        k = words[_INSTANCE + j]
                        part = instance_part[k] + words[_PART + j]
                        first_face = part_table[part, 0]
                        first_vertex = part_table[part, 1]
                        m = part_table[part, 2]
                        material_of[j] = m
                        texture = material_texture[m]
                        tu = _ZERO
                        tv = _ZERO
                        if first_face < 0:
                            n0 = floats[_NORMAL + j]
                            n1 = floats[_NORMAL + 16 + j]
                            n2 = floats[_NORMAL + 32 + j]
                            if texture >= 0:
                                long_n = math.sqrt(n0 * n0 + n1 * n1 + n2 * n2)
                                tu = np.float32(math.atan2(n1, n0) / (2 * math.pi) + 0.5)
                                tv = np.float32(math.asin(n2 / long_n) / math.pi + 0.5)
                        else:
                            face = first_face + words[_FACE + j]
                            a = first_vertex + faces[face, 0]
                            b = first_vertex + faces[face, 1]
                            c = first_vertex + faces[face, 2]
                            bu = floats[_U + j]
                            bv = floats[_V + j]
                            bw = _ONE - bu - bv
                            n0 = bw * normals[a, 0] + bu * normals[b, 0] + bv * normals[c, 0]
                            n1 = bw * normals[a, 1] + bu * normals[b, 1] + bv * normals[c, 1]
                            n2 = bw * normals[a, 2] + bu * normals[b, 2] + bv * normals[c, 2]
                            if texture >= 0:
                                tu = bw * uv[a, 0] + bu * uv[b, 0] + bv * uv[c, 0]
                                tv = bw * uv[a, 1] + bu * uv[b, 1] + bv * uv[c, 1]
                        nx = (
                            normal_matrix[k, 0, 0] * n0
                            + normal_matrix[k, 0, 1] * n1
                            + normal_matrix[k, 0, 2] * n2
                        )
                        ny = (
                            normal_matrix[k, 1, 0] * n0
                            + normal_matrix[k, 1, 1] * n1
                            + normal_matrix[k, 1, 2] * n2
                        )
                        nz = (
                            normal_matrix[k, 2, 0] * n0
                            + normal_matrix[k, 2, 1] * n1
                            + normal_matrix[k, 2, 2] * n2
                        )
                        shrink = _ONE / math.sqrt(nx * nx + ny * ny + nz * nz + np.float32(1e-30))
                        nx *= shrink
                        ny *= shrink
                        nz *= shrink
                        facing = (nx * dx + ny * dy + nz * dz) * inverse_length
                        if facing > 0:
                            nx = -nx
                            ny = -ny
                            nz = -nz
                            facing = -facing
                        normal[j, 0] = nx
                        normal[j, 1] = ny
                        normal[j, 2] = nz
                        towards[j, 0] = -dx * inverse_length
                        towards[j, 1] = -dy * inverse_length
                        towards[j, 2] = -dz * inverse_length
                        # Off the surface, so that it does not shadow itself.
                        lift = np.float32(5e-4) + t * np.float32(2e-4)
                        point[j, 0] = camera[0] + dx * t + nx * lift
                        point[j, 1] = camera[1] + dy * t + ny * lift
                        point[j, 2] = camera[2] + dz * t + nz * lift
                        base[j, 0] = _ONE
                        base[j, 1] = _ONE
                        base[j, 2] = _ONE
                        if texture >= 0:
                            tu = (tu - _HALF) * materials[m, 14] + _HALF
                            tv = (tv - _HALF) * materials[m, 15] + _HALF
                            footprint = (
                                t
                                / inverse_length
                                * pixel_angle
                                * part_density[part]
                                / max(np.float32(0.3), -facing)
                            )
                            detail = _ZERO
                            if footprint > _ONE:
                                detail = np.float32(math.log2(footprint))
                            level = min(int(detail), level_count[texture] - 1)
                            red, green, blue = _texel(
                                texels,
                                levels[texture, level, 0],
                                levels[texture, level, 1],
                                levels[texture, level, 2],
                                tu,
                                tv,
                            )
                            part_up = detail - np.float32(level)
                            if part_up > np.float32(0.1) and level + 1 < level_count[texture]:
                                red2, green2, blue2 = _texel(
                                    texels,
                                    levels[texture, level + 1, 0],
                                    levels[texture, level + 1, 1],
                                    levels[texture, level + 1, 2],
                                    tu,
                                    tv,
                                )
                                red += (red2 - red) * part_up
                                green += (green2 - green) * part_up
                                blue += (blue2 - blue) * part_up
                            scale = np.float32(1 / 255.0)
                            base[j, 0] = red * scale
                            base[j, 1] = green * scale
                            base[j, 2] = blue * scale
                        for c in range(3):
                            shine[j, c] = _ZERO
                            lit[j, c] = (
                                ambient[c] * materials[m, c] + materials[m, 6 + c]
                                if material_lit[m]
                                else materials[m, 3 + c]
                            )
                    for number in range(light_count):
                        kind = lights[number, 0]
                        anything = False
                        for j in range(16):
                            words[shadow_valid_row + j] = 0
                            strength[j] = _ZERO
                            if shown[j] == 0 or not material_lit[material_of[j]]:
                                continue
                            reach = np.float32(3e38)
                            power = _ONE
                            if kind == 0:
                                lx = -lights[number, 4]
                                ly = -lights[number, 5]
                                lz = -lights[number, 6]
                            else:
                                lx = lights[number, 1] - point[j, 0]
                                ly = lights[number, 2] - point[j, 1]
                                lz = lights[number, 3] - point[j, 2]
                                reach = math.sqrt(lx * lx + ly * ly + lz * lz) + np.float32(1e-9)
                                lx /= reach
                                ly /= reach
                                lz /= reach
                                if reach > lights[number, 13]:
                                    continue
                                power = _ONE / (
                                    lights[number, 14]
                                    + lights[number, 15] * reach
                                    + lights[number, 16] * reach * reach
                                )
                                if kind == 2:
                                    along = -(
                                        lx * lights[number, 4]
                                        + ly * lights[number, 5]
                                        + lz * lights[number, 6]
                                    )
                                    span = lights[number, 17] - lights[number, 18]
                                    part_in = (along - lights[number, 18]) / max(
                                        span, np.float32(1e-6)
                                    )
                                    if part_in <= 0:
                                        continue
                                    power *= min(part_in, _ONE) ** lights[number, 19]
                            cosine = normal[j, 0] * lx + normal[j, 1] * ly + normal[j, 2] * lz
                            if cosine <= 0:
                                continue
                            strength[j] = power
                            to_light[j, 0] = lx
                            to_light[j, 1] = ly
                            to_light[j, 2] = lz
                            if lights[number, 20] != 0:
                                floats[shadow + _FROM + j] = point[j, 0]
                                floats[shadow + _FROM + 16 + j] = point[j, 1]
                                floats[shadow + _FROM + 32 + j] = point[j, 2]
                                floats[shadow + _ALONG + j] = lx
                                floats[shadow + _ALONG + 16 + j] = ly
                                floats[shadow + _ALONG + 32 + j] = lz
                                floats[shadow + _FAR + j] = reach
                                words[shadow_valid_row + j] = -1
                                anything = True
                        if anything:
                            _occluded16(
                                address + shadow_valid_row * 4,
                                scene,
                                address + shadow * 4,
                                arguments,
                            )
                        for j in range(16):
                            if strength[j] == 0:
                                continue
                            if words[shadow_valid_row + j] != 0 and floats[shadow + _FAR + j] < 0:
                                continue
                            m = material_of[j]
                            lx = to_light[j, 0]
                            ly = to_light[j, 1]
                            lz = to_light[j, 2]
                            cosine = normal[j, 0] * lx + normal[j, 1] * ly + normal[j, 2] * lz
                            for c in range(3):
                                lit[j, c] += (
                                    strength[j]
                                    * cosine
                                    * lights[number, 7 + c]
                                    * materials[m, 3 + c]
                                )
                            if materials[m, 12] > 0:
                                hx = lx + towards[j, 0]
                                hy = ly + towards[j, 1]
                                hz = lz + towards[j, 2]
                                half = (
                                    normal[j, 0] * hx + normal[j, 1] * hy + normal[j, 2] * hz
                                ) / math.sqrt(hx * hx + hy * hy + hz * hz + np.float32(1e-9))
                                if half > 0:
                                    gloss = strength[j] * np.float32(half ** materials[m, 12])
                                    for c in range(3):
                                        shine[j, c] += (
                                            gloss * lights[number, 10 + c] * materials[m, 9 + c]
                                        )
                    for j in range(16):
                        if shown[j] == 0:
                            continue
                        opacity = materials[material_of[j], 13]
                        if layer == _LAYERS - 1:
                            opacity = _ONE
                        for c in range(3):
                            colour = lit[j, c] * base[j, c] + shine[j, c]
                            total[j, c] += through[j] * opacity * min(_ONE, max(_ZERO, colour))
                        through[j] *= _ONE - opacity
                        if opacity < np.float32(0.999):
                            floats[_NEAR + j] = floats[_FAR + j] * np.float32(1.00001) + np.float32(
                                1e-5
                            )
                            floats[_FAR + j] = clip[1]
                            words[_PART + j] = -1
                            words[_INSTANCE + j] = -1
                            again = True
                        else:
                            words[valid_row + j] = 0
                    if not again:
                        break
                    _intersect16(address + valid_row * 4, scene, address, arguments)
            if want_rgb:
                for j in range(16):
                    row_number = y + (j >> 2)
                    column = x + (j & 3)
                    if row_number < height and column < width:
                        for c in range(3):
                            rgb[row_number, column, c] = np.uint8(
                                total[j, c] * np.float32(255.0) + _HALF
                            )
