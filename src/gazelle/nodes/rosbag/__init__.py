"""``rosbag/record`` and ``rosbag/play``, for launch files and for the command line."""

from __future__ import annotations
