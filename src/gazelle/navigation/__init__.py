"""Localisation, costmaps, planners, controllers and recoveries, without topics or a clock.

Poses are (x_m, y_m, yaw_rad), single or as rows of float64 arrays. Options are frozen dataclasses
whose fields are named as ROS's parameters (`gazelle.parameters.dataclass_tables`).
"""

from __future__ import annotations
