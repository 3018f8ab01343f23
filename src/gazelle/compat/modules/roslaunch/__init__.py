"""roslaunch from Python, on Gazelle's launches."""

import sys as _sys

from gazelle.compat.roslaunch import *  # noqa: F403
from gazelle.compat.roslaunch import core, parent, rlutil, scriptapi
from gazelle.compat.roslaunch.rlutil import configure_logging

for _name, _module in {
    "core": core,
    "parent": parent,
    "pmon": core,
    "rlutil": rlutil,
    "scriptapi": scriptapi,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
    globals()[_name] = _module
