"""ROS distributions: their generation and the end of their support."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["DISTRIBUTIONS", "Distribution"]


class Distribution(NamedTuple):
    """A ROS distribution.

    Attributes:
        ros_version: 1 or 2.
        end: month in which its support ended or ends, ``YYYY-MM``.
        gazebo: the Gazebo it is used with.
        is_over: support has ended (as of Gazelle's own release).
    """

    name: str
    ros_version: int
    end: str
    gazebo: str
    is_over: bool = True


# REP-3 and REP-2000.
_ROWS = (
    Distribution("diamondback", 1, "2012-05", "Gazebo 0"),
    Distribution("electric", 1, "2013-01", "Gazebo 0"),
    Distribution("fuerte", 1, "2013-06", "Gazebo 1.0"),
    Distribution("groovy", 1, "2014-07", "Gazebo 1.5"),
    Distribution("hydro", 1, "2015-05", "Gazebo 1.9"),
    Distribution("indigo", 1, "2019-04", "Gazebo 2"),
    Distribution("jade", 1, "2017-05", "Gazebo 5"),
    Distribution("kinetic", 1, "2021-04", "Gazebo 7"),
    Distribution("lunar", 1, "2019-05", "Gazebo 7"),
    Distribution("melodic", 1, "2023-06", "Gazebo 9"),
    Distribution("noetic", 1, "2025-05", "Gazebo 11"),
    Distribution("dashing", 2, "2021-05", "Gazebo 9"),
    Distribution("eloquent", 2, "2020-11", "Gazebo 9"),
    Distribution("foxy", 2, "2023-06", "Gazebo 11"),
    Distribution("galactic", 2, "2022-12", "Gazebo 11"),
    Distribution("humble", 2, "2027-05", "Gazebo 11 or Fortress", False),
    Distribution("iron", 2, "2024-12", "Gazebo 11 or Fortress"),
    Distribution("jazzy", 2, "2029-05", "Harmonic", False),
    Distribution("kilted", 2, "2026-12", "Ionic", False),
    Distribution("rolling", 2, "", "Jetty", False),
)
DISTRIBUTIONS = {row.name: row for row in _ROWS}
