"""Publishes the readings of the sensor that a plug-in stands in, with noise of its own."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import NO_NOISE, Noise
from gazelle.simulator.plugins.context import PluginContext, SensorPlace
from gazelle.simulator.plugins.plugin_parameters import PluginReader
from gazelle.simulator.scheduler import ORDER_SENSOR

__all__ = [
    "gaussian",
    "once_per_step",
    "prefixed_frame",
    "publish_at",
    "sensor_period",
    "sensor_place",
    "throttled_period",
]


def gaussian(context: PluginContext, sigma: float) -> Callable[[int], NDArray[np.float64]]:
    """Return a source of (count,) normal values; seeded from the world's seed and the names.

    A reset of the world starts it over, so that two runs are alike.
    """
    from gazelle.sensors import noise_stream

    noise = Noise("gaussian", stddev=sigma) if sigma > 0 else NO_NOISE
    key = (context.host.seed, f"{context.model.name}::{context.plugin.name}")
    streams = [noise_stream(noise, *key)]

    def restart() -> None:
        streams[0] = noise_stream(noise, *key)

    context.resources.on_reset(restart)
    return lambda count: streams[0].apply(np.zeros(count))


Reading = TypeVar("Reading")


def sensor_place(
    context: PluginContext, wanted: type | tuple[type, ...], noun: str
) -> SensorPlace | None:
    """Return the sensor the plug-in stands in; reports a wrong place and returns None.

    Args:
        context: the plug-in's.
        wanted: kinds of sensors it can read.
        noun: what the message calls them, with its article.
    """
    place = context.place
    if place is not None and isinstance(place.sensor.spec, wanted):
        return place
    found = f"a sensor of type '{place.sensor.type}'" if place else "no sensor"
    text = f"plug-in '{context.plugin.name}' ({context.plugin.filename}) needs {noun} around it "
    context.report("plugin.wrong-place", text + f"and stands in {found}; it is left out")
    return None


def publish_at(
    context: PluginContext,
    topic: str,
    type_name: str,
    period_steps: Fraction,
    build: Callable[[int], Any],
    *,
    order: int = ORDER_SENSOR,
) -> None:
    """Publish `build(time_ns)` every so many steps, while somebody listens.

    A build that returns None publishes nothing at that time.
    """
    engine = context.host.engine
    publisher = context.resources.publisher(topic, type_name)

    def publish() -> None:
        message = build(engine.time_ns)
        if message is not None:
            publisher.publish(message)

    name = f"{context.plugin.name} {topic}"
    context.resources.task(
        name, period_steps, publish, order=order, wanted=lambda: publisher.matched
    )


def once_per_step(context: PluginContext, read: Callable[[], Reading]) -> Callable[[], Reading]:
    """Return a reader that gives all who ask at one moment the same reading."""
    engine = context.host.engine
    kept: dict[int, Reading] = {}

    def read_once() -> Reading:
        if engine.time_ns not in kept:
            kept.clear()
            kept[engine.time_ns] = read()
        return kept[engine.time_ns]

    context.resources.on_reset(kept.clear)
    return read_once


def sensor_period(context: PluginContext, place: SensorPlace) -> Fraction:
    """Return the period of a sensor's ``<update_rate>``."""
    return place.period_in_steps(context.host.engine.step_ns)


def throttled_period(context: PluginContext, place: SensorPlace, rate_hz: float) -> Fraction:
    """Return the period of a plug-in that skips whole readings of its sensor; 0 Hz skips none."""
    return place.period_in_steps(context.host.engine.step_ns, rate_hz)


def prefixed_frame(context: PluginContext, parameters: PluginReader, key: str) -> str:
    """Return the frame of a key as tf::resolve does since ROS Hydro.

    The namespace's ``tf_prefix`` goes before it; an absolute name has none and loses its slash.
    """
    frame = parameters.text(key)
    if frame.startswith("/"):
        return frame.removeprefix("/")
    prefix = context.tf_prefix(context.namespace(parameters)).strip("/")
    return f"{prefix}/{frame}" if prefix else frame
