"""launch_testing_ros, on Gazelle's graph."""

import sys as _sys
from types import ModuleType as _ModuleType

from launch_testing import test_runner as _runner
from launch_testing import tools as _tools

from gazelle.compat.launch_ros import launch_testing_ros as _testing
from gazelle.compat.launch_ros.launch_testing_ros import (
    DataRepublisher,
    MessagePump,
    WaitForTopics,
    get_rmw_output_filter,
)

__all__ = ["DataRepublisher", "LaunchTestRunner", "MessagePump", "WaitForTopics", "tools"]


class LaunchTestRunner(_runner.LaunchTestRunner):
    """launch_testing's own."""


def basic_output_filter(
    filtered_prefixes=None, filtered_patterns=None, filtered_rmw_implementation=None
):
    """Return a filter of output lines, with those of a middleware left out too."""
    prefixes = ["pid", "rc"] if filtered_prefixes is None else list(filtered_prefixes)
    patterns = list(filtered_patterns or ())
    if filtered_rmw_implementation:
        prefixes = prefixes + get_rmw_output_filter(filtered_rmw_implementation, "prefixes")
        patterns = patterns + get_rmw_output_filter(filtered_rmw_implementation, "patterns")
    return _tools.basic_output_filter(prefixes, patterns)


tools = _ModuleType(f"{__name__}.tools")
tools.basic_output_filter = basic_output_filter
tools.get_rmw_output_filter = get_rmw_output_filter
_runners = _ModuleType(f"{__name__}.test_runner")
_runners.LaunchTestRunner = LaunchTestRunner
for _name, _module in {
    "tools": tools,
    "tools.output": tools,
    "test_runner": _runners,
    "data_republisher": _testing,
    "message_pump": _testing,
    "wait_for_topics": _testing,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
    if "." not in _name:
        globals()[_name] = _module
