"""launch_testing, by Gazelle: `gazelle.launch.ros2.testing` at the paths that ROS 2 has it."""

import sys as _sys

from gazelle.launch.ros2.testing import *  # noqa: F403
from gazelle.launch.ros2.testing import (
    actions,
    asserts,
    command,
    event_handlers,
    handlers,
    loader,
    lookup,
    markers,
    matching,
    proxy,
    ready_aggregator,
    results,
    runner,
    tools,
)

_MODULES = {
    "actions": actions,
    "actions.gtest": actions,
    "actions.pytest": actions,
    "actions.ready": actions,
    "actions.test": actions,
    "asserts": asserts,
    "asserts.assert_exit_codes": asserts,
    "asserts.assert_output": asserts,
    "asserts.assert_sequential_output": asserts,
    "decorator": markers,
    "event_handlers": event_handlers,
    "event_handlers.stdout_ready_listener": event_handlers,
    "io_handler": handlers,
    "junitxml": results,
    "launch_test": command,
    "loader": loader,
    "markers": markers,
    "parse_arguments": runner,
    "proc_info_handler": handlers,
    "ready_aggregator": ready_aggregator,
    "test_result": results,
    "test_runner": runner,
    "tools": tools,
    "tools.output": tools,
    "tools.process": proxy,
    "tools.text": matching,
    "util": lookup,
    "util.proc_lookup": lookup,
}
try:
    from gazelle.testing import launch_test_plugin as _hooks
except ModuleNotFoundError as _error:
    # Launch tests of unittest run without pytest.
    if _error.name != "pytest":
        raise
else:
    _MODULES |= {"pytest": _hooks, "pytest.hooks": _hooks}
for _name, _module in _MODULES.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
    if "." not in _name:
        globals()[_name] = _module
