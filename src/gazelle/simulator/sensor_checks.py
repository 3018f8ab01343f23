"""Looks at the sensors of a model before it runs: what is out of place or gives no data."""

from __future__ import annotations

from gazelle.description.model import (
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    LogicalCameraSpec,
    Model,
    World,
)
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.simulator.plugins.context import SensorPlace

__all__ = ["check_sensor"]


def check_sensor(place: SensorPlace, model: Model, world: World, diagnostics: Diagnostics) -> bool:
    """Report what is wrong with a sensor; True when it can be read."""
    spec = place.sensor.spec
    if isinstance(spec, LogicalCameraSpec):
        text = f"sensor '{place.name}' is of type '{place.sensor.type}', which is not simulated"
        diagnostics.report("simulator.sensor-not-simulated", text, place.sensor.span)
        return False
    if isinstance(spec, ForceTorqueSpec) != bool(place.joint_name):
        _report_misplaced(place, model, diagnostics)
        return False
    if isinstance(spec, ContactSpec):
        _check_collisions(place, spec, model, diagnostics)
    if isinstance(spec, GpsSpec) and world.spherical_coordinates is None:
        text = f"sensor '{place.name}' measures where on Earth it is, and the world has no "
        text += "<spherical_coordinates>: it counts from latitude 0, longitude 0"
        diagnostics.report("simulator.no-place-on-earth", text, place.sensor.span)
    return True


def _report_misplaced(place: SensorPlace, model: Model, diagnostics: Diagnostics) -> None:
    kind, name = place.sensor.type, place.sensor.name
    if place.joint_name:
        joint = place.joint_name.split("::", 1)[1]
        fix = f"move it to a link, such as '{place.link_name.split('::', 1)[1]}'"
        text = f"sensor '{name}' of type '{kind}' sits in joint '{joint}' and needs a link"
    else:
        link = place.link_name.split("::", 1)[1]
        held = [joint.name for joint in model.joints if joint.child == link]
        text = f"sensor '{name}' of type '{kind}' sits on link '{link}' and needs a joint"
        fix = f"move it to joint '{held[0]}'" if held else "move it to a joint"
    diagnostics.report(
        "simulator.sensor-misplaced", f"{text}; it gives no data", place.sensor.span, fix=fix
    )


def _check_collisions(
    place: SensorPlace, spec: ContactSpec, model: Model, diagnostics: Diagnostics
) -> None:
    link = model.link(place.link_name.split("::", 1)[1])
    assert link is not None
    names = [collision.name for collision in link.collisions]
    of_others = {f"{one.name}::{item.name}" for one in model.links for item in one.collisions}
    for wanted in spec.collisions:
        if wanted not in names and wanted not in of_others:
            text = f"contact sensor '{place.name}' watches collision '{wanted}', which link "
            text += f"'{link.name}' does not have: it never feels anything there"
            fix = did_you_mean(wanted, names) or f"the link's collisions: {', '.join(names) or '-'}"
            diagnostics.report("simulator.no-such-collision", text, place.sensor.span, fix=fix)
    if not spec.collisions:
        text = f"contact sensor '{place.name}' names no collision: it never feels anything"
        fix = f"write <collision>{names[0]}</collision>" if names else ""
        diagnostics.report("simulator.no-such-collision", text, place.sensor.span, fix=fix)
