"""Launch arguments: declared, given and read under the same names."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from gazelle.diagnostics import Diagnostics, Severity, did_you_mean, nearest_names
from gazelle.doctor.launch_ros2.launch_tree import Followed
from gazelle.workspace.environment_paths import BUILTIN

__all__ = ["check_arguments"]


def check_arguments(root: Followed, arguments: Mapping[str, str], diagnostics: Diagnostics) -> None:
    """Report arguments that are read and never declared, declared and never read, or mistyped.

    Args:
        root: the outermost file.
        arguments: given on the command line.
        diagnostics: receives the findings.
    """
    for item in root.walk():
        _check_uses(item, diagnostics)
        if item.include is not None:
            _check_given(item, diagnostics)
    _check_idle(root.walk(), diagnostics)
    declared = [argument.name for argument in root.file.arguments]
    for name in arguments:
        if name not in declared and nearest_names(name, declared):
            text = f"the launch file declares no argument '{name}'; it has no effect"
            hint = did_you_mean(name, declared)
            diagnostics.report("launch_ros2.argument-unknown", text, fix=hint)


def _check_uses(item: Followed, diagnostics: Diagnostics) -> None:
    declared = {argument.name for argument in item.file.arguments} | set(item.given)
    seen: set[str] = set()
    for use in item.file.uses:
        if use.name in declared or use.name in seen or not use.name:
            continue
        seen.add(use.name)
        hint = did_you_mean(use.name, declared)
        text = f"launch configuration '{use.name}' does not exist: no DeclareLaunchArgument "
        text += "declares it; the launch stops there"
        text += "" if hint else f", unless {use.name}:=… is given"
        fix = hint or f"add DeclareLaunchArgument('{use.name}', default_value=…)"
        severity = Severity.ERROR if hint else Severity.WARNING
        code = "launch_ros2.argument-undeclared"
        diagnostics.report(code, text, use.span, fix=fix, severity=severity)


def _check_given(item: Followed, diagnostics: Diagnostics) -> None:
    """Report arguments of an include that nothing below it reads, when one is nearly the same."""
    include = item.include
    assert include is not None
    if not all(inner.has_all for inner in item.walk()):
        return
    known = {argument.name for inner in item.walk() for argument in inner.file.arguments}
    known |= {use.name for inner in item.walk() for use in inner.file.uses}
    for name in include.arguments:
        near = nearest_names(name, known)
        if name in known or not near or any(_names(inner, name) for inner in item.walk()):
            continue
        text = (
            f"'{name}' is given to {item.file.path.name}, which has no such argument; ROS 2 says "
        )
        text += "nothing and goes on"
        hint = did_you_mean(name, known)
        diagnostics.report("launch_ros2.argument-unknown", text, include.span, fix=hint)


def _check_idle(items: Sequence[Followed], diagnostics: Diagnostics) -> None:
    if not all(item.has_all for item in items):
        return
    for item in items:
        if item.file.path.is_relative_to(BUILTIN):
            # It declares what the original does, whoever reads it.
            continue
        below = item.walk()
        if any(inner.file.computes_uses for inner in below):
            continue
        used = {use.name for inner in below for use in inner.file.uses}
        for argument in item.file.arguments:
            if argument.name in used or any(_names(inner, argument.name) for inner in below):
                continue
            text = f"argument '{argument.name}' is declared and nothing reads it"
            hint = did_you_mean(argument.name, used - _declared(item))
            diagnostics.report("launch_ros2.argument-idle", text, argument.span, fix=hint)


def _declared(item: Followed) -> set[str]:
    return {argument.name for argument in item.file.arguments}


def _names(item: Followed, name: str) -> bool:
    """Tell whether a name stands in a file at a place that declares nothing."""
    pattern = re.compile(rf"[\"'(\s]{re.escape(name)}[\"')\s]")
    declared = sum(argument.name == name for argument in item.file.arguments)
    return len(pattern.findall(item.file.text)) > declared
