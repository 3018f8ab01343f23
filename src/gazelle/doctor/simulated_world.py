"""What is reported of a world that has come up: plug-ins, idle tags, controllers, probes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import PurePath

from gazelle.description.model import Model, PluginTag, World
from gazelle.diagnostics import Diagnostic, SourceSpan
from gazelle.doctor.dry_start import DryStart, StartPlan
from gazelle.doctor.report import Examination, Section
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.plugins.registry import all_tables, looked_up, plain_name

__all__ = ["plugins_section", "probe", "simulation_sections", "tags_section"]

# Codes that say of an element that it has no, or not its full, effect.
_TAG_CODES = frozenset(
    {
        "control.transmission-idle",
        "engine.friction-direction",
        "engine.idle-contact-word",
        "engine.idle-joint-word",
        "engine.slip",
        "engine.velocity-decay",
        "parameter.idle",
        "parameter.unknown",
        "sdf.actor",
        "sdf.extension",
        "sdf.not-simulated",
        "sdf.sensor-not-simulated",
        "simulator.sensor-not-simulated",
        "urdf.gazebo-no-effect",
        "urdf.old-controller",
        "urdf.sensor-ignored",
        "xml.unknown-attribute",
        "xml.unknown-tag",
    }
)
_MISSING_CODES = {
    "plugin.unknown": "NOT THERE: compiled code",
    "plugin.compiled": "NOT THERE: your C++",
    "plugin.user-error": "your Python: fails",
    "plugin.user-class": "your Python: fails",
    "plugin.missing-joint": "LEFT OUT: a joint is missing",
    "plugin.missing-link": "LEFT OUT: a link is missing",
    "plugin.wrong-place": "LEFT OUT: stands in the wrong place",
    "plugin.named-only": "NOT SIMULATED, known by name",
    "plugin.without-effect": "nothing, as in Gazebo",
}


def plugins_section(world: World, findings: Iterable[Diagnostic], *, subject: str = "") -> Section:
    """Return a row for every plug-in of a world: what it is and what runs in its place.

    Args:
        world: as it is after everything was spawned.
        findings: of loading it.
        subject: what the table is about.
    """
    wrong = {
        span: _MISSING_CODES[item.code]
        for item in findings
        if item.code in _MISSING_CODES
        for span in _plugin_spans(item)
    }
    rows = tuple(
        (plugin.filename or plugin.name, owner, _done(plugin, wrong), _location(plugin.span))
        for owner, plugin in _plugins(world)
    )
    return Section("plugins", "plug-ins", ("plug-in", "of", "what runs", "place"), rows, subject)


def tags_section(findings: Iterable[Diagnostic], *, subject: str = "") -> Section:
    """Return a row for every finding about a tag that has no effect."""
    rows = tuple(
        (_location(item.span), item.message.partition("\n")[0], item.code)
        for item in findings
        if item.code in _TAG_CODES
    )
    return Section("tags", "tags without effect", ("place", "what", "code"), rows, subject)


def simulation_sections(
    start: DryStart, findings: Iterable[Diagnostic], *, subject: str
) -> tuple[Section, ...]:
    """Return the tables of plug-ins, tags without effect and controllers.

    Args:
        start: the world.
        findings: of bringing it up.
        subject: what the tables are about.
    """
    found = tuple(findings)
    return (
        plugins_section(start.world, found, subject=subject),
        tags_section(found, subject=subject),
        _controllers(start, subject),
    )


def probe(start: DryStart, plan: StartPlan, examination: Examination) -> None:
    """Run the probes over a world with its parameters; nothing unless the options say so."""
    if not examination.options.probe:
        return
    from gazelle.doctor.probes import run_probes

    sections = run_probes(
        start.world,
        workspace=examination.workspace,
        parameters=plan.parameters,
        diagnostics=examination.diagnostics,
        progress=examination.say,
    )
    examination.add(*sections)


def _plugin_spans(item: Diagnostic) -> Iterator[SourceSpan | None]:
    """Yield the places of a finding about a plug-in: its own file may be to blame."""
    yield item.span
    if item.span is not None:
        for number, place in enumerate(item.span.via):
            yield replace(place, via=item.span.via[number + 1 :])


def _plugins(world: World) -> Iterator[tuple[str, PluginTag]]:
    for plugin in world.plugins:
        yield f"world {world.name}", plugin
    for model in world.models:
        for plugin in model.plugins:
            yield model.name, plugin
        yield from _sensor_plugins(model)


def _sensor_plugins(model: Model) -> Iterator[tuple[str, PluginTag]]:
    for link in model.links:
        for sensor in link.sensors:
            for plugin in sensor.plugins:
                yield f"{model.name} sensor {sensor.name}", plugin


def _done(plugin: PluginTag, wrong: dict[SourceSpan | None, str]) -> str:
    if plugin.span in wrong:
        return wrong[plugin.span]
    for name in looked_up(plugin):
        table = _tables_by_name().get(name)
        if table is not None:
            return table.parameters.family
    return "your Python"


@cache
def _tables_by_name() -> dict[str, PluginTable]:
    return {plain_name(name): table for table in all_tables() for name in table.parameters.types}


def _location(span: SourceSpan | None) -> str:
    if span is None:
        return ""
    return f"{PurePath(span.file).name}:{span.line}" if span.line else PurePath(span.file).name


def _controllers(start: DryStart, subject: str) -> Section:
    rows = tuple(
        (manager.namespace, name, kind, state or "not started", ", ".join(joints))
        for manager in start.managers
        for name, kind, state, joints in manager.rows
    )
    columns = ("namespace", "controller", "type", "state", "joints")
    return Section("controllers", "controllers", columns, rows, subject)
