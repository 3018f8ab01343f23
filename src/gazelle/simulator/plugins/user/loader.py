"""Loads a plug-in of the user's own and runs its hooks; its mistakes stop nothing but itself."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any

from gazelle.control.python_controllers.adapter import error_span, error_text, located
from gazelle.extensions import entry_point_text, folder_of
from gazelle.simulator.plugins.context import PluginContext, Resources
from gazelle.simulator.plugins.user.finder import (
    PythonPlugin,
    compiled_plugin,
    installed_plugin,
    python_plugin,
    stems,
)
from gazelle.simulator.plugins.user.plugin_api import (
    ModelPlugin,
    Plugin,
    PluginNode,
    PluginParameters,
    SensorPlugin,
    WorldOfPlugin,
    WorldPlugin,
)
from gazelle.simulator.scheduler import ORDER_CONTROL, period_in_steps
from gazelle.simulator.simulation_handles import SimModel, SimSensor
from gazelle.workspace.python_files import import_python_file

__all__ = ["load_user_plugin", "report_compiled"]

_ROLES: dict[str, type[Plugin]] = {
    "World": WorldPlugin,
    "Model": ModelPlugin,
    "Sensor": SensorPlugin,
}


def load_user_plugin(context: PluginContext) -> bool:
    """Start the Python plug-in that a filename means; False when there is none.

    A file without a fitting class, and code that raises, are reported: that is True as well.
    """
    beside = context.model.file or context.host.engine.world.file
    found = python_plugin(context.plugin.filename, context.host.workspace, beside)
    if found is None:
        return _load_installed(context)
    runner = _Runner(context, found)
    name = f"gazelle_user_plugins.{found.path.stem}_{found.path.stat().st_mtime_ns}"
    made = runner.guarded(lambda: import_python_file(found.path, name))
    wanted = None if made is None else _class_in(made, context, found)
    if wanted is not None:
        runner.start(wanted)
    return True


def _load_installed(context: PluginContext) -> bool:
    point = installed_plugin(context.plugin.filename)
    if point is None:
        return False
    runner = _Runner(context, PythonPlugin(Path(point.value), folder_of(point)))
    wanted = runner.guarded(point.load)
    if wanted is None:
        return True
    role = _role(context)
    if isinstance(wanted, type) and issubclass(wanted, _ROLES[role]):
        runner.start(wanted)
        return True
    text = f"plug-in '{context.plugin.name}' stands in a {role.lower()} and needs a class derived "
    text += f"from {role}Plugin; {entry_point_text(point)} is {_kind_of(wanted)}; it is left out"
    fix = f"derive it from gazelle.simulator.plugins.user.{role}Plugin"
    context.report("plugin.user-class", text, fix=fix)
    return True


def _kind_of(part: Any) -> str:
    if isinstance(part, type):
        return f"a {part.__mro__[1].__name__}" if len(part.__mro__) > 1 else part.__name__
    return f"a {type(part).__name__}, no class"


def report_compiled(context: PluginContext) -> bool:
    """Report a plug-in whose C++ source is in the workspace; False when it is not."""
    filename = context.plugin.filename
    found = compiled_plugin(filename, context.host.workspace)
    if found is None:
        return False
    role = _role(context)
    stem = stems(filename)[0]
    source = f"{found.source}:1, " if found.source is not None else ""
    text = f"plug-in '{filename}' (name '{context.plugin.name}') is compiled code of package "
    text += f"'{found.package.name}' ({source}{found.lists}:{found.line}), which Gazelle does not "
    text += "load; what it does in Gazebo does not happen here"
    fix = f"write it in Python: a file {stem}.py anywhere in package '{found.package.name}', with "
    fix += f"a class derived from gazelle.simulator.plugins.user.{role}Plugin"
    context.report("plugin.compiled", text, fix=fix)
    return True


class _Runner:
    """One plug-in: its object, what it opened, and the end of it when it raises."""

    def __init__(self, context: PluginContext, found: PythonPlugin) -> None:
        self._context = context
        self._found = found
        self._resources = Resources(context.host)
        self._user: Plugin | None = None
        self._failed = False
        context.resources.on_close(self._close)
        context.resources.on_reset(self._reset)

    def start(self, wanted: type[Plugin]) -> None:
        """Make the object, call ``load`` and have ``on_update`` called from now on."""
        context = self._context
        user = self.guarded(wanted)
        if user is None:
            return
        parameters = PluginParameters(context)
        node = PluginNode(context, self._resources, self.guarded)
        self.guarded(lambda: user.load(_subject(context), parameters, node))
        if self._failed:
            return
        self._user = user
        if type(user).on_update is not Plugin.on_update:
            engine = context.host.engine

            def update() -> None:
                self.guarded(lambda: user.on_update(engine.time_ns * 1e-9))

            name = f"{context.plugin.name} on_update"
            period = self._period(user)
            self._resources.task(name, period, update, order=ORDER_CONTROL)

    def guarded(self, action: Callable[[], Any]) -> Any:
        """Run code of the user's; an error is reported once and ends the plug-in."""
        if self._failed:
            return None
        try:
            return action()
        except Exception as error:  # noqa: BLE001 - a user's code raises what it likes
            self._failed, self._user = True, None
            plugin = self._context.plugin
            folder = self._found.folder
            text = f"plug-in '{plugin.name}' ({self._found.path.name}) raised and is stopped; the "
            text += "world goes on"
            place = error_span(error, folder)
            message = f"{text}: {error_text(error, folder)}"
            self._context.report("plugin.user-error", message, at=place)
            self._context.host.node.log("ERROR", f"{text}: {located(error, folder)}")
            self._resources.close()
            return None

    def _period(self, user: Plugin) -> Fraction:
        step_ns, place = self._context.host.engine.step_ns, self._context.place
        if user.update_rate_hz is not None:
            return period_in_steps(user.update_rate_hz, step_ns)
        return place.period_in_steps(step_ns) if place else Fraction(1)

    def _reset(self) -> None:
        if self._user is not None:
            self.guarded(self._user.on_reset)

    def _close(self) -> None:
        if self._user is not None:
            self.guarded(self._user.close)
        self._resources.close()


def _role(context: PluginContext) -> str:
    if context.place is not None:
        return "Sensor"
    return "World" if context.is_of_world else "Model"


def _subject(context: PluginContext) -> Any:
    match _role(context):
        case "Sensor":
            assert context.place is not None
            return SimSensor(context.host, context.place)
        case "Model":
            return SimModel(context.host, context.model.name)
        case _:
            return WorldOfPlugin(context.host)


def _class_in(
    module: ModuleType, context: PluginContext, found: PythonPlugin
) -> type[Plugin] | None:
    """Return the class of the right role that a file defines; reports when there is not one."""
    role = _role(context)
    own = [
        item
        for item in vars(module).values()
        if inspect.isclass(item) and item.__module__ == module.__name__ and issubclass(item, Plugin)
    ]
    fitting = [item for item in own if issubclass(item, _ROLES[role])]
    named = [item for item in fitting if item.__name__ == context.plugin.name.rpartition("::")[2]]
    chosen = named or fitting
    if len(chosen) == 1:
        return chosen[0]
    text = f"plug-in '{context.plugin.name}' stands in a {role.lower()} and needs a class derived "
    text += f"from {role}Plugin; {found.path} "
    if chosen:
        text += f"has several: {', '.join(item.__name__ for item in chosen)}"
        fix = "give the <plugin> the name of the class that is meant"
    else:
        names = ", ".join(f"{item.__name__} (a {item.__mro__[1].__name__})" for item in own)
        text += f"has {names or 'none'}"
        fix = f"derive it from gazelle.simulator.plugins.user.{role}Plugin"
    context.report("plugin.user-class", f"{text}; it is left out", fix=fix)
    return None
