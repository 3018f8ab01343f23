#!/usr/bin/env python3
"""The xacro command where launch files look for it: ``$(find xacro)/xacro``."""

from __future__ import annotations

import sys
from importlib import import_module

if __name__ == "__main__":
    # Python puts the script's folder first, where "xacro" would mean this file.
    del sys.path[0]
    sys.argv[:] = ["gazelle", "xacro", *sys.argv[1:]]
    sys.exit(import_module("gazelle.cli.main").main())
