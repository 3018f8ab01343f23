"""launch_testing, by Gazelle: `gazelle.launch.ros2.launch_testing` where ROS 2 has it."""

import sys as _sys

from gazelle.launch.ros2.launch_testing import *  # noqa: F403
from gazelle.launch.ros2.launch_testing import (
    actions,
    asserts,
    event_handlers,
    launch_test,
    loader,
    markers,
    output_text,
    proc_lookup,
    process_handlers,
    process_proxy,
    ready_aggregator,
    test_result,
    test_runner,
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
    "io_handler": process_handlers,
    "junitxml": test_result,
    "launch_test": launch_test,
    "loader": loader,
    "markers": markers,
    "parse_arguments": test_runner,
    "proc_info_handler": process_handlers,
    "ready_aggregator": ready_aggregator,
    "test_result": test_result,
    "test_runner": test_runner,
    "tools": tools,
    "tools.output": tools,
    "tools.process": process_proxy,
    "tools.text": output_text,
    "util": proc_lookup,
    "util.proc_lookup": proc_lookup,
}
try:
    from gazelle.testing import launch_testing_plugin as _hooks
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
