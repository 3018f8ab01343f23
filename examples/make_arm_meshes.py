"""Make the meshes of the example arm: one convex part per link, written as binary STL.

Run it from this folder: ``python make_arm_meshes.py``. The meshes are in the repository, so nobody
needs to; it is here to show where they come from. Every link's frame is at its joint, and the arm
stands straight up with all joints at zero. Lengths are in m.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from make_meshes import circle, prism, rounded_box, write_stl

MESHES = Path(__file__).parent / "arm_ws" / "src" / "heron_description" / "meshes"


def main() -> None:
    """Write all meshes."""
    MESHES.mkdir(parents=True, exist_ok=True)
    write_stl(MESHES / "base.stl", prism(circle(0.085, 48), 0.0, 0.12, top_scale=0.8))
    write_stl(MESHES / "shoulder.stl", prism(circle(0.06, 48), 0.0, 0.14, top_scale=0.9))
    write_stl(MESHES / "upper_arm.stl", prism(rounded_box(0.08, 0.1, 0.03), -0.04, 0.34, 0.85))
    write_stl(MESHES / "forearm.stl", prism(rounded_box(0.065, 0.075, 0.025), -0.04, 0.12, 0.8))
    write_stl(MESHES / "wrist_1.stl", prism(circle(0.028, 32), 0.0, 0.16))
    write_stl(MESHES / "wrist_2.stl", prism(rounded_box(0.05, 0.06, 0.02), -0.03, 0.058))
    write_stl(MESHES / "flange.stl", prism(circle(0.03, 32), 0.0, 0.018))
    write_stl(MESHES / "hand.stl", prism(rounded_box(0.05, 0.15, 0.015), 0.0, 0.045))
    finger = prism(rounded_box(0.02, 0.014, 0.002), 0.0, 0.065)
    write_stl(MESHES / "finger.stl", finger + np.array([0.0, 0.007, 0.0]))


if __name__ == "__main__":
    main()
