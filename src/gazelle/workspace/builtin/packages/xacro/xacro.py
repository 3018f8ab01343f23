#!/usr/bin/env python3
"""The xacro command where launch files look for it: ``$(find xacro)/xacro``."""

from __future__ import annotations

import os
import shutil
import sys
from importlib import import_module
from importlib.util import find_spec

if __name__ == "__main__":
    # Python puts the script's folder first, where "xacro" would mean this file.
    del sys.path[0]
    command = shutil.which("xacro")
    if find_spec("gazelle") is None and command is not None:
        # Started through a script of the user's, by a Python that is not Gazelle's.
        os.execv(command, [command, *sys.argv[1:]])  # noqa: S606
    sys.argv[:] = ["gazelle", "xacro", *sys.argv[1:]]
    sys.exit(import_module("gazelle.cli.main").main())
