"""``Simulation.plot()``: joints, links, sensors and topics over a run."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gazelle.description.model import JointType
from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError, NotFoundError
from gazelle.geometry.pose import rpy_from_quat_xyzw
from gazelle.graph import Entity, Kind
from gazelle.interfaces.stamps import seconds_of
from gazelle.notebook.charts import TIME, Line, chart_bundle, chart_sheet
from gazelle.notebook.drawing import painted, svg_of
from gazelle.rich_display import Bundle
from gazelle.simulator.run_history import RunHistory, Samples, Track
from gazelle.simulator.simulation import full_name
from gazelle.studio.errors import StudioError
from gazelle.studio.graph_view.plot import curves_of, read_number

if TYPE_CHECKING:
    from gazelle.simulator import Simulation

__all__ = ["Plot", "plot"]

_OF_JOINTS = ("position", "velocity", "effort")
_OF_LINKS = ("x", "y", "z", "roll", "pitch", "yaw")
_STEP = re.compile(r"([A-Za-z_]\w*)|\[(\d+)\]|/(\d+)")
_UNITS = {"effort": ("N·m", "N"), "position": ("rad", "m"), "velocity": ("rad/s", "m/s")}
_SENSOR_HZ = 50.0


class _Curve(NamedTuple):
    name: str
    read: Callable[[], Samples]
    unit: str = ""


class Plot:
    """Curves over the run; it shows what was recorded up to the moment when it is looked at.

    Attributes:
        names: of the curves.
    """

    def __init__(self, curves: Iterable[_Curve]) -> None:
        """Use `Simulation.plot`."""
        self._curves = tuple(curves)
        self.names = tuple(one.name for one in self._curves)

    def __repr__(self) -> str:
        return f"<plot of {', '.join(self.names)}>"

    @property
    def data(self) -> dict[str, Samples]:
        """Times (``times_s``) and values (``values``) of each curve, as arrays."""
        return {one.name: one.read() for one in self._curves}

    def save(self, path: str | Path) -> Path:
        """Write it to a file: ``.svg``, ``.png``, ``.pdf`` (as pixels) or ``.csv``.

        Raises:
            ValueError: the file's name ends otherwise.
            OSError: it cannot be written.
        """
        path = Path(path)
        write = _WRITERS.get(path.suffix.lower())
        if write is None:
            kinds = ", ".join(_WRITERS)
            raise ValueError(f"'{path}': plots are written as {kinds}; name the file so")
        write(self, path)
        return path

    def bundle(self) -> Bundle:
        """Return it as a notebook shows it."""
        lines = self._lines()
        empty = [line.name for line in lines if not len(line.times_s)]
        words = ""
        if empty:
            words = f"{', '.join(empty)}: recorded from now on; run, and look again"
        return chart_bundle(lines, x_label=TIME, y_label=self._unit(), caption=words)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Bundle:
        return {**self.bundle(), "text/plain": repr(self)}

    def _lines(self) -> list[Line]:
        return [Line(name, one.times_s, one.values) for name, one in self.data.items()]

    def _unit(self) -> str:
        return ", ".join(dict.fromkeys(one.unit for one in self._curves if one.unit))


def plot(sim: Simulation, history: RunHistory, names: Iterable[str]) -> Plot:
    """Return a plot of what names stand for; what is not recorded yet is from now on.

    Raises:
        NotFoundError: there is no such thing; the message names the nearest.
        GazelleError: nothing was named, or it is no number.
    """
    curves = [curve for name in names for curve in _curves(sim, history, name)]
    if not curves:
        raise GazelleError(
            "plot() needs names of what to plot, such as 'joint_1/position', 'base_link/x', "
            "'imu/linear_acceleration_m_s2[0]' or '/odom/twist/twist/linear/x'"
        )
    return Plot(curves)


def _curves(sim: Simulation, history: RunHistory, name: str) -> Iterator[_Curve]:
    if name.startswith("/"):
        yield from _of_topic(sim, history, name)
        return
    part, _, quantity = name.rpartition("/")
    engine = sim.server.engine
    if quantity in _OF_JOINTS and part:
        yield _of_joint(sim, history, full_name("joint", part, engine.joint_names), quantity)
    elif quantity in _OF_LINKS and part:
        yield _of_link(sim, history, part, quantity)
    elif part:
        yield _of_sensor(sim, history, name)
    else:
        joint = full_name("joint", name, engine.joint_names)
        yield _of_joint(sim, history, joint, "position")


def _of_joint(sim: Simulation, history: RunHistory, joint: str, quantity: str) -> _Curve:
    handle = sim.server.engine.joint(joint)
    if not handle.is_driveable:
        raise NotFoundError("joint that moves", joint, hint=f"it is {handle.type.value}")
    name = f"{_short(joint, sim.server.engine.joint_names)}/{quantity}"
    unit = _UNITS[quantity][handle.type is JointType.PRISMATIC]
    if quantity == "effort":
        if name not in history.tracks:
            history.follow(name, lambda: handle.effort)
        return _Curve(name, history.tracks[name].samples, unit)
    column = _OF_JOINTS.index(quantity)

    def read() -> Samples:
        found = history.joint(joint)
        return _EMPTY if found is None else Samples(found.times_s, found.values[:, column])

    return _Curve(name, read, unit)


def _of_link(sim: Simulation, history: RunHistory, part: str, quantity: str) -> _Curve:
    names = sim.server.engine.link_names
    models = {one.name: one for one in sim.world.models}
    model = models.get(part)
    if model is not None and model.links:
        link = f"{model.name}::{model.canonical_link or model.links[0].name}"
    else:
        link = full_name("link", part, names)
    column = _OF_LINKS.index(quantity)

    def read() -> Samples:
        found = history.link(link)
        if found is None:
            return _EMPTY
        if column < 3:
            return Samples(found.times_s, found.values[:, column])
        angles = [
            rpy_from_quat_xyzw(tuple(row))[column - 3] for row in found.values[:, 3:].tolist()
        ]
        return Samples(found.times_s, np.unwrap(np.array(angles, np.float64)))

    return _Curve(f"{part}/{quantity}", read, "m" if column < 3 else "rad")


def _of_sensor(sim: Simulation, history: RunHistory, name: str) -> _Curve:
    """Read a sensor's number; each reading takes the next of the sensor's noise."""
    place, _, rest = name.partition("/")
    sensor = sim.sensor(place)
    steps = [word or int(first or second) for word, first, second in _STEP.findall(rest)]

    def read() -> float:
        return _number(sensor.read(), steps, name)

    if name not in history.tracks:
        read()
        rate_hz = sensor.description.update_rate_hz or _SENSOR_HZ
        history.follow(name, read, min(rate_hz, _SENSOR_HZ))
    return _Curve(name, history.tracks[name].samples)


def _number(record: Any, steps: list[Any], name: str) -> float:
    value = record
    for step in steps:
        try:
            value = value[step] if isinstance(step, int) else getattr(value, step)
        except (AttributeError, IndexError, TypeError):
            known = [one for one in dir(value) if not one.startswith("_")]
            near = nearest_names(str(step), known)
            hint = "" if near else f"there are: {', '.join(known[:12])}"
            raise NotFoundError("reading", name, nearest=near, hint=hint) from None
    try:
        return float(value)
    except (TypeError, ValueError):
        raise GazelleError(
            f"'{name}' is no number but {type(value).__name__}\n  fix: name an item of it, such "
            f"as '{name}[0]'"
        ) from None


def _of_topic(sim: Simulation, history: RunHistory, name: str) -> Iterator[_Curve]:
    server = sim.server
    try:
        curves = curves_of(name, _known_topics(sim), lambda topic: None)
    except StudioError as error:
        topics = {one.name for one in _known_topics(sim)}
        known = error.known or nearest_names(f"/{name.split('/')[1]}", topics)
        meant = "' or '".join(known[:3])
        near = f"; did you mean '{meant}'?" if meant else ""
        hint = f"\n  {error.hint}" if error.hint else ""
        raise GazelleError(f"{error}{near}{hint}") from error
    for one in curves:
        if one.name not in history.tracks:
            track = history.tracks[one.name] = Track()

            def take(message: Any, track: Track = track, steps: Any = one.steps) -> None:
                value = read_number(message, steps)
                at_s = _stamp_s(message) or server.time_ns * 1e-9
                track.note(at_s, float("nan") if value is None else value)

            history.listen(one.topic, take)
        yield _Curve(one.name, history.tracks[one.name].samples)


def _known_topics(sim: Simulation) -> list[Entity]:
    node = sim.server.node
    graph = getattr(node, "graph", None)
    if graph is not None:
        return list(graph.entities())
    topics: dict[str, str] = node.topics  # type: ignore[attr-defined]
    return [Entity("", 0, 0, Kind.PUBLISHER, "", *one) for one in topics.items()]


def _stamp_s(message: Any) -> float:
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    return 0.0 if stamp is None else float(seconds_of(stamp))


def _short(name: str, names: Iterable[str]) -> str:
    """Return a joint's name without its model where that is enough."""
    last = name.partition("::")[2]
    return last if sum(one.endswith(f"::{last}") for one in names) == 1 else name


def _write_svg(made: Plot, path: Path) -> None:
    sheet = chart_sheet(made._lines(), made._unit())
    path.write_text(svg_of(sheet, on_paper=True), encoding="utf-8")


def _write_pixels(made: Plot, path: Path) -> None:
    painted(chart_sheet(made._lines(), made._unit())).save(path)


def _write_csv(made: Plot, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("name", "time_s", "value"))
        for name, one in made.data.items():
            pairs = zip(one.times_s.tolist(), one.values.tolist(), strict=True)
            writer.writerows((name, time_s, value) for time_s, value in pairs)


_EMPTY = Samples(np.empty(0), np.empty(0))
_WRITERS: dict[str, Callable[[Plot, Path], None]] = {
    ".csv": _write_csv,
    ".pdf": _write_pixels,
    ".png": _write_pixels,
    ".svg": _write_svg,
}
