"""Motions of joints: trajectories over time, planned paths waypoint by waypoint."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.notebook.charts import Line, chart_bundle
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.motion.moveit_config_planner import PlannedMotion
    from gazelle.motion.planning.problem import Path
    from gazelle.motion.timing.trajectory import Trajectory

__all__ = ["joint_lines", "motion_bundle", "path_bundle", "trajectory_bundle"]


def trajectory_bundle(trajectory: Trajectory) -> Bundle:
    """Return the joints' positions over time."""
    words = [
        f"{len(trajectory.names)} joints, {trajectory.duration_s:.3g} s, "
        f"{len(trajectory.times_s)} samples",
        *trajectory.notes,
    ]
    lines = joint_lines(trajectory.names, trajectory.times_s, trajectory.positions)
    return chart_bundle(lines, y_label="position, rad or m", caption="; ".join(words))


def motion_bundle(motion: PlannedMotion) -> Bundle:
    """Return a planned motion: when the joints are where."""
    return trajectory_bundle(motion.trajectory)


def path_bundle(path: Path) -> Bundle:
    """Return the joints' positions along a path that has no times yet."""
    steps = np.linalg.norm(np.diff(path.waypoints, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    lines = joint_lines(path.names, along, path.waypoints)
    words = f"{len(path.waypoints)} waypoints, length {path.length:.3g} rad or m"
    if path.planner:
        words += f", {path.planner} in {path.planning_time_s:.2f} s"
    return chart_bundle(
        lines,
        x_label="length along the path, rad or m",
        y_label="position, rad or m",
        caption="; ".join([words, *path.notes]),
    )


def joint_lines(names: Sequence[str], times_s: Any, positions: Any) -> list[Line]:
    """Return a line for each joint of positions (M, N) at times (M,)."""
    times, values = np.asarray(times_s, np.float64), np.asarray(positions, np.float64)
    return [Line(name, times, values[:, column]) for column, name in enumerate(names)]
