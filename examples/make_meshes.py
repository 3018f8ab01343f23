"""Make the meshes of the example robots: plain shapes, written as binary STL.

Run it from this folder: ``python make_meshes.py``. The meshes are in the repository, so nobody
needs to; it is here to show where they come from.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

SCOUT = Path(__file__).parent / "scout_ws" / "src" / "scout_robot" / "meshes"


def prism(outline: np.ndarray, z0: float, z1: float, top_scale: float = 1.0) -> np.ndarray:
    """Return triangles (N, 3, 3) of a convex outline (counter-clockwise), extruded along z."""
    low = np.column_stack([outline, np.full(len(outline), z0)])
    high = np.column_stack([outline * top_scale, np.full(len(outline), z1)])
    triangles = []
    for i in range(len(outline)):
        j = (i + 1) % len(outline)
        triangles += [(low[i], low[j], high[j]), (low[i], high[j], high[i])]
        if 0 < i < len(outline) - 1:
            triangles += [(low[0], low[j], low[i]), (high[0], high[i], high[j])]
    return np.asarray(triangles)


def circle(radius: float, count: int) -> np.ndarray:
    """Return points on a circle."""
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles)])


def rounded_box(x: float, y: float, radius: float, count: int = 6) -> np.ndarray:
    """Return the outline of a rectangle with round corners."""
    points = []
    for quarter, (sx, sy) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        angles = np.linspace(0, np.pi / 2, count) + quarter * np.pi / 2
        centre = np.array([sx * (x / 2 - radius), sy * (y / 2 - radius)])
        points += [centre + radius * np.array([np.cos(a), np.sin(a)]) for a in angles]
    return np.asarray(points)


def write_stl(path: Path, *parts: np.ndarray) -> None:
    """Write triangles as binary STL, normals from the corners' order."""
    triangles = np.concatenate(parts).astype("<f4")
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    data = np.zeros(len(triangles), record)
    data["normal"], data["corners"] = normals, triangles
    header = b"Gazelle example mesh".ljust(80, b" ")
    path.write_bytes(header + struct.pack("<I", len(data)) + data.tobytes())


def main() -> None:
    """Write all meshes."""
    SCOUT.mkdir(parents=True, exist_ok=True)
    body = prism(rounded_box(0.36, 0.24, 0.04), -0.04, 0.03)
    lid = prism(rounded_box(0.34, 0.22, 0.04), 0.03, 0.05, top_scale=0.9)
    write_stl(SCOUT / "body.stl", body, lid)
    write_stl(SCOUT / "wheel.stl", prism(circle(0.05, 64), -0.015, 0.015))
    write_stl(
        SCOUT / "lidar.stl",
        prism(circle(0.035, 48), -0.03, 0.0),
        prism(circle(0.03, 48), 0.0, 0.02, top_scale=0.9),
    )
    write_stl(SCOUT / "camera.stl", prism(rounded_box(0.025, 0.09, 0.01), -0.0125, 0.0125))


if __name__ == "__main__":
    main()
