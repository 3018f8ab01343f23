"""The SLAM engine: scans and odometry in, a trajectory and a map out."""

from __future__ import annotations

from gazelle.mapping.slam.drawing import MapDrawer
from gazelle.mapping.slam.engine import Slam, SlamResult, Update, slam
from gazelle.mapping.slam.parameters import SlamParameters

__all__ = ["MapDrawer", "Slam", "SlamParameters", "SlamResult", "Update", "slam"]
