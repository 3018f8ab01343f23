"""What launch has, as a page: ``python -m gazelle.launch.ros2.documentation > docs/launch.md``."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any

from gazelle.launch.ros2 import (
    actions,
    conditions,
    descriptions,
    event_handlers,
    events,
    launch_description_sources,
    launch_ros,
    launch_testing,
    nav2_common,
    ros_gz,
    substitutions,
)
from gazelle.launch.ros2.events import process
from gazelle.launch.ros2.frontend.expose import action_parse_methods, substitution_parse_methods
from gazelle.launch.ros2.launch_testing import asserts, markers, tools
from gazelle.launch.ros2.launch_testing import event_handlers as test_handlers

__all__ = ["reference_markdown"]

_HEAD = """# launch, launch_ros and launch_testing

Everything of these packages of ROS 2, Foxy to Jazzy, that launch files and tests import; each row
is executed in a test. This page is generated:
`python -m gazelle.launch.ros2.documentation > docs/launch.md`.
"""
_SECTIONS: dict[str, ModuleType] = {
    "launch.actions": actions,
    "launch.substitutions": substitutions,
    "launch.conditions": conditions,
    "launch.event_handlers": event_handlers,
    "launch.events": events,
    "launch.events.process": process,
    "launch.launch_description_sources": launch_description_sources,
    "launch.descriptions": descriptions,
    "launch_ros.actions": launch_ros.actions,
    "launch_ros.substitutions": launch_ros.substitutions,
    "launch_ros.descriptions": launch_ros.descriptions,
    "launch_ros.event_handlers": launch_ros.event_handlers,
    "launch_ros.events": launch_ros.events,
    "launch_ros.events.lifecycle": launch_ros.events.lifecycle,
    "ros_gz_sim.actions, ros_gz_bridge.actions": ros_gz,
    "nav2_common.launch": nav2_common,
    "launch_testing": launch_testing,
    "launch_testing.actions": launch_testing.actions,
    "launch_testing.asserts": asserts,
    "launch_testing.event_handlers": test_handlers,
    "launch_testing.markers": markers,
    "launch_testing.tools": tools,
}


def reference_markdown() -> str:
    """Return the page: a table per module, with the tags of XML and YAML."""
    tags = _tags(action_parse_methods, "<{}>") | _tags(substitution_parse_methods, "$({})")
    lines = [_HEAD]
    for title, module in _SECTIONS.items():
        lines += [f"## {title}", "", "| name | what it is | in XML |", "| --- | --- | --- |"]
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing) or inspect.isfunction(thing):
                text = (inspect.getdoc(thing) or "").split("\n\n")[0].replace("\n", " ")
                lines.append(f"| `{name}` | {text} | {tags.get(name, '')} |")
        lines.append("")
    return "\n".join(lines)


def _tags(methods: dict[str, Callable[..., Any]], form: str) -> dict[str, str]:
    """Return the tags by the names of the classes they stand for."""
    found: dict[str, list[str]] = {}
    for tag, method in methods.items():
        owner = getattr(inspect.unwrap(method), "__self__", None)
        if inspect.isclass(owner) and owner.__module__.startswith("gazelle.launch.ros2."):
            found.setdefault(owner.__name__, []).append(f"`{form.format(tag)}`")
    return {name: ", ".join(sorted(tags)) for name, tags in found.items()}


if __name__ == "__main__":
    sys.stdout.write(reference_markdown())
