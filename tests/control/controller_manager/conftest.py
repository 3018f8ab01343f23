"""A robot of two joints without physics, and a manager over it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import pytest
from tests.control.fake_robot import RECORDER, Hardware, Recorder, fake_robot

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.controllers import registry
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.diagnostics import Diagnostics
from gazelle.simulator.intra_process_node import LocalParameters


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


@dataclass
class Bench:
    """A manager with everything around it."""

    manager: ControllerManager
    hardware: Hardware
    diagnostics: Diagnostics
    store: LocalParameters
    ports: dict[str, FakePorts]

    def controller(self, name: str) -> Recorder:
        found = self.manager.controllers[name].controller
        assert isinstance(found, Recorder)
        return found

    def words(self, name: str) -> list[str]:
        return [str(call[0]) for call in self.controller(name).calls]


@pytest.fixture
def make_bench(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Bench]:
    """Makes a bench: ``make_bench(generation, {controller: parameters})``."""
    types = {RECORDER: Recorder}
    monkeypatch.setattr(registry, "_by_type", lambda: types)

    def make(
        ros_version: int = 1,
        controllers: Mapping[str, Mapping[str, Any]] | None = None,
        *,
        rate_hz: float = 1000.0,
        **options: Any,
    ) -> Bench:
        store, diagnostics = LocalParameters(), Diagnostics()
        for name, values in (controllers or {}).items():
            store.set(f"/mira/{name}", {"type": RECORDER, **values})
        robot, hardware = fake_robot(ros_version)
        ports: dict[str, FakePorts] = {}

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
            **options,
        )
        return Bench(manager, hardware, diagnostics, store, ports)

    return make
