"""launch_pytest, by Gazelle."""

import sys as _sys

from gazelle.launch.ros2.launch_testing import actions
from gazelle.launch.ros2.launch_testing import pytest_tools as tools
from gazelle.testing import launch_pytest_plugin as plugin
from gazelle.testing.launch_pytest_plugin import fixture

__all__ = ["actions", "fixture", "tools"]

tools.process = tools
for _name, _module in {
    "actions": actions,
    "plugin": plugin,
    "tools": tools,
    "tools.process": tools,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
