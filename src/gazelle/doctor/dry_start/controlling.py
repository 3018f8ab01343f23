"""Controllers loaded and started as spawners would."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from gazelle.control.checks import configured_controllers
from gazelle.control.controller_manager import ControllerManager
from gazelle.control.errors import ControllerError
from gazelle.control.parameter_sources.ros2_node_parameters import FileSource
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.dry_start.plan import ControllerStart, Manager
from gazelle.graph.names import resolve

__all__ = ["managers_of", "start_controllers"]


def start_controllers(
    start: ControllerStart, managers: Mapping[str, ControllerManager], diagnostics: Diagnostics
) -> None:
    """Load and start what a spawner names; report what a run would fail at.

    Args:
        start: the spawner's wishes.
        managers: by namespace, absolute.
        diagnostics: receives the findings.
    """
    namespace = start.manager.rpartition("/")[0] or "/"
    manager = managers.get(namespace)
    if manager is None:
        _report_no_manager(start, managers, diagnostics)
        return
    loaded = [name for name in start.names if _load(name, start, manager, diagnostics)]
    if not start.starts or not loaded:
        return
    # ROS 1 starts all at once, ROS 2 one after the other.
    groups = [loaded] if manager.robot.ros_version == 1 else [[name] for name in loaded]
    for names in groups:
        try:
            manager.switch(start=names)
        except ControllerError as error:
            text = f"'{_full_name(start)}' cannot start {', '.join(names)}: {error}"
            diagnostics.report("doctor.controller-fails", text, start.by.span)


def managers_of(managers: Mapping[str, ControllerManager]) -> tuple[Manager, ...]:
    """Return what is known of every manager and its controllers, loaded or only configured."""
    found = []
    for namespace, manager in managers.items():
        rows = {
            item.name: (item.name, item.type, "", item.joints)
            for item in configured_controllers(manager.source)
        }
        for name, record in manager.controllers.items():
            joints = rows[name][3] if name in rows else ()
            rows[name] = (name, record.type, str(record.state.value), joints)
        found.append(Manager(namespace, manager.robot.ros_version, tuple(rows.values())))
    return tuple(found)


def _load(
    name: str, start: ControllerStart, manager: ControllerManager, diagnostics: Diagnostics
) -> bool:
    for file in start.files:
        manager.source.set("", f"{name}.params_file", [str(Path(file).resolve())])
    type_name = start.type or _type_in(start, name)
    try:
        manager.load(name, type_name or None)
        manager.configure(name)
    except ControllerError as error:
        text = f"'{_full_name(start)}' cannot load controller '{name}': {error}"
        known = [item.name for item in configured_controllers(manager.source)]
        near = "" if name in known else did_you_mean(name, known)
        if name not in known:
            text += f"; {manager.namespace} has parameters of: {', '.join(known) or 'none'}"
        diagnostics.report("doctor.controller-fails", text, start.by.span, fix=near)
        return False
    return True


def _type_in(start: ControllerStart, name: str) -> str:
    if not start.files:
        return ""
    files = [Path(file) for file in start.files]
    return FileSource(files, start.by.namespace, Diagnostics()).controller_type(name) or ""


def _report_no_manager(
    start: ControllerStart, managers: Mapping[str, ControllerManager], diagnostics: Diagnostics
) -> None:
    names = [resolve("controller_manager", namespace) for namespace in managers]
    known = f"there is {', '.join(names)}" if names else "no robot of this launch has one"
    text = f"'{_full_name(start)}' waits for {start.manager}, which nobody runs; {known}"
    if names:
        wanted = (names[0].rpartition("/")[0] or "/").rstrip("/") or "/"
        fix = f'start it with ns="{wanted}", or set <robotNamespace> of the plug-in to match'
    else:
        fix = "add a <plugin> libgazebo_ros_control.so to the robot, or spawn it before"
    diagnostics.report("doctor.no-controller-manager", text, start.by.span, fix=fix)


def _full_name(start: ControllerStart) -> str:
    return resolve(start.by.name, start.by.namespace)
