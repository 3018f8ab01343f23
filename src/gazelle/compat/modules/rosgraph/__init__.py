"""rosgraph: the calls that node programs make to a master, and names."""

import sys as _sys

from gazelle.compat.rosgraph import masterapi as _rosgraph
from gazelle.compat.rosgraph import names
from gazelle.compat.rosgraph.masterapi import *  # noqa: F403
from gazelle.graph.names import parse_command_line as _parse

masterapi = network = rosenv = _rosgraph
for _name in ("masterapi", "network", "rosenv"):
    _sys.modules[f"{__name__}.{_name}"] = _rosgraph
_sys.modules[f"{__name__}.names"] = names


def myargv(argv=None):
    """Return the arguments without ROS's own."""
    return _parse(_sys.argv if argv is None else argv).rest
