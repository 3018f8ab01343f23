"""Starts this half; run by its path with ROS's Python."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

if __name__ == "__main__":
    # Only for this one import: the folder above has names that others may use too.
    sys.path[0] = str(Path(__file__).resolve().parents[1])
    main = import_module("rclpy_side.bridge_process").main
    del sys.path[0]
    main()
