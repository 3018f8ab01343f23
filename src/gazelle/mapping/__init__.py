"""Maps from laser scans and odometry, without a graph: records in, maps and trajectories out."""

from __future__ import annotations
