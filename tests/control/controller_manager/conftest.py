"""A robot of two joints without physics, and a manager over it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import pytest

from gazelle.control.bank import InterfaceBank
from gazelle.control.controller_manager import ControllerManager
from gazelle.control.controllers import registry
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.robot import JointResource, Robot
from gazelle.control.sources.store import StoreSource
from gazelle.control.table import ControllerTable, Parameter
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.simulator.local_node import LocalParameters


class Hardware:
    """Commands become states at once; everything it is told is written down."""

    name, type, plugin = "block", "system", "test/Hardware"
    writes_every_step = False

    def __init__(self, bank: InterfaceBank, joints: tuple[JointResource, ...]) -> None:
        self.bank, self.joints = bank, joints
        self.log: list[Any] = []
        self.refusal = ""

    def read(self, time_ns: int, period_ns: int) -> None:
        self.log.append(("read", time_ns))

    def write(self, time_ns: int, period_ns: int) -> None:
        self.log.append(("write", time_ns))

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        return self.refusal

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        self.log.append(("switch", start, stop))

    def reset(self) -> None:
        self.log.append(("reset",))


class FakePorts:
    """Remembers what was offered."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.services: dict[str, Callable[[Any, Any], None]] = {}
        self.types: dict[str, str] = {}
        self.lines: list[tuple[str, str]] = []
        self.values: dict[str, Any] = {}
        self.on_set: Callable[[dict[str, Any]], str] = lambda values: ""
        self.closed = False

    def service(self, name: str, type_name: str, handler: Callable[[Any, Any], None]) -> None:
        self.services[name] = handler
        self.types[name] = type_name

    def log(self, level: str, text: str) -> None:
        self.lines.append((level, text))

    def offer_parameters(
        self, values: Mapping[str, Any], on_set: Callable[[dict[str, Any]], str]
    ) -> None:
        self.values, self.on_set = dict(values), on_set

    def close(self) -> None:
        self.closed = True


class Recorder(Controller):
    """Claims one interface of its joint and writes down what happens to it."""

    TABLE: ClassVar[ControllerTable] = ControllerTable(
        "recorder",
        "test",
        ("test_controllers/Recorder",),
        "any",
        (
            Parameter("joint", "text", None, "joint"),
            Parameter("interface", "text", "effort", "interface"),
            Parameter("gain", "number", 1.0, "gain", live=True),
            Parameter("fails_in", "text", "", "where to raise"),
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        context.parameters.require("joint")
        self._fails_in = context.parameters.text("fails_in")
        self.gain = context.parameters.number("gain")
        joint = context.parameters.text("joint")
        self.commands = (f"{joint}/{context.parameters.text('interface')}",)
        context.command_places(self.commands)
        self.states = (f"{joint}/position",)
        self.calls: list[tuple[Any, ...]] = []

    def start(self, time_ns: int) -> None:
        self._do("start", time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        self._do("update", time_ns, period_ns)

    def stop(self, time_ns: int) -> None:
        self._do("stop", time_ns)

    def changed(self, values: dict[str, Any]) -> str:
        if values.get("gain", 0) < 0:
            return "gain must not be negative"
        self.gain = values["gain"]
        return ""

    def close(self) -> None:
        self.calls.append(("close",))

    def _do(self, *call: Any) -> None:
        self.calls.append(call)
        if call[0] == self._fails_in:
            raise ValueError("broken on purpose")


@dataclass
class Bench:
    """A manager with everything around it."""

    manager: ControllerManager
    hardware: Hardware
    diagnostics: Diagnostics
    store: LocalParameters
    ports: dict[str, FakePorts]
    claims: list[frozenset[str]] = field(default_factory=list)

    def controller(self, name: str) -> Recorder:
        found = self.manager.controllers[name].controller
        assert isinstance(found, Recorder)
        return found

    def words(self, name: str) -> list[str]:
        return [str(call[0]) for call in self.controller(name).calls]


@pytest.fixture
def make_bench(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Bench]:
    """Makes a bench: ``make_bench(generation, {controller: parameters})``."""
    types = {"test_controllers/Recorder": Recorder}
    monkeypatch.setattr(registry, "_by_type", lambda: types)

    def make(
        generation: int = 1,
        controllers: Mapping[str, Mapping[str, Any]] | None = None,
        *,
        rate_hz: float = 1000.0,
        **options: Any,
    ) -> Bench:
        store, diagnostics = LocalParameters(), Diagnostics()
        for name, values in (controllers or {}).items():
            store.set(f"/mira/{name}", {"type": "test_controllers/Recorder", **values})
        interfaces = ("position", "velocity", "effort")
        names = ("hardware_interface/EffortJointInterface",)
        joints = tuple(
            JointResource(name, interfaces, interfaces, names) for name in ("left", "right")
        )
        bank = InterfaceBank()
        for joint in joints:
            for interface in interfaces:
                bank.add_state(f"{joint.name}/{interface}", 0.0)
                bank.add_command(f"{joint.name}/{interface}")
        bank.freeze()
        hardware = Hardware(bank, joints)
        robot = Robot(generation, Model("mira"), bank, (hardware,), {j.name: j for j in joints})
        ports: dict[str, FakePorts] = {}
        claims: list[frozenset[str]] = []

        def make_ports(name: str) -> Any:
            ports[name] = FakePorts(name)
            return ports[name]

        manager = ControllerManager(
            robot,
            namespace="/mira",
            make_ports=make_ports,
            source=StoreSource(store, "/mira"),
            diagnostics=diagnostics,
            update_rate_hz=rate_hz,
            on_claim=claims.append,
            **options,
        )
        return Bench(manager, hardware, diagnostics, store, ports, claims)

    return make
