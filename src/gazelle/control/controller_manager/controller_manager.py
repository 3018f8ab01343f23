"""The controller manager: loads controllers, switches them, runs them in the control loop."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_manager.controller_loader import CompiledFinder, ControllerMaker
from gazelle.control.controller_manager.controller_spec import (
    ControllerRecord,
    ControllerState,
    OwnedPorts,
)
from gazelle.control.controller_manager.switching import SwitchPlan, plan_switch
from gazelle.control.errors import ControllerError
from gazelle.control.parameter_sources.ros1_parameter_server import ParameterSource
from gazelle.control.resource_manager import Robot
from gazelle.diagnostics import Diagnostics, did_you_mean

if TYPE_CHECKING:
    from gazelle.workspace import Workspace

__all__ = ["ControllerManager"]

NS_PER_S = 1_000_000_000


class ControllerManager:
    """Owns the controllers of one robot.

    Requests (`load`, `configure`, `switch`, `unload`) act at once, between two steps; time need
    not pass for them, so they work while a simulation is paused.

    Attributes:
        robot: the hardware.
        namespace: absolute, ``/`` for none.
        source: parameters of the controllers.
        diagnostics: receives what goes wrong in parameters and controllers.
        update_rate_hz: of the control loop.
    """

    def __init__(  # noqa: PLR0913 - users give all by keyword
        self,
        robot: Robot,
        *,
        namespace: str,
        make_ports: Callable[[str], OwnedPorts],
        source: ParameterSource,
        diagnostics: Diagnostics,
        update_rate_hz: float,
        workspace: Workspace | None = None,
        clock: Callable[[], int] | None = None,
        find_compiled: CompiledFinder | None = None,
    ) -> None:
        """Take over a robot; nothing is loaded yet.

        Args:
            robot: the hardware.
            namespace: of the manager and its controllers.
            make_ports: opens the ports of a controller by its name.
            source: where parameters come from.
            diagnostics: receives findings.
            update_rate_hz: how often `update` is called.
            workspace: where controllers written in Python are looked for.
            clock: gives the time in ns for what happens between updates; the time of the last
                update when None.
            find_compiled: finds a class of C++ by its type's name; not looked for when None.
        """
        self.robot = robot
        self.namespace = "/" + namespace.strip("/")
        self.source = source
        self.diagnostics = diagnostics
        self.update_rate_hz = update_rate_hz
        self._maker = ControllerMaker(
            robot, source, make_ports, diagnostics, workspace, self.namespace, find_compiled
        )
        self._clock = clock
        self._records: dict[str, ControllerRecord] = {}
        self._running: tuple[ControllerRecord, ...] = ()
        self._time_ns = 0

    @property
    def controllers(self) -> Mapping[str, ControllerRecord]:
        """The loaded controllers by name, in the order they were loaded."""
        return MappingProxyType(self._records)

    @property
    def now_ns(self) -> int:
        """The time that started and stopped controllers are told."""
        return self._time_ns if self._clock is None else self._clock()

    def load(self, name: str, type_name: str | None = None) -> ControllerRecord:
        """Load a controller; ros_control's is made now, ros2_control's when it is configured.

        Args:
            name: relative to the namespace.
            type_name: its type; the one of its parameters when None.

        Raises:
            ControllerError: it is loaded already, has no type, no such type exists, or it cannot
                be made.
        """
        if name in self._records:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        chosen = type_name or self._maker.type_of(name)
        self._maker.class_of(name, chosen)
        self._take_named(name)
        record = ControllerRecord(name, chosen, ControllerState.UNCONFIGURED, self._rate_of(name))
        if self.robot.ros_version == 1:
            self._make(record)
        self._records[name] = record
        return record

    def configure(self, name: str) -> None:
        """Make a loaded controller read its parameters; an inactive one starts over.

        Raises:
            ControllerError: it is not loaded, is active, or cannot be made.
        """
        record = self._record(name, "configure")
        if record.is_active:
            raise ControllerError(f"Controller '{name}' can not be configured from 'active' state.")
        if record.controller is not None:
            if self.robot.ros_version == 1:
                return
            self._unmake(record)
        record.update_rate_hz = self._rate_of(name)
        self._make(record)

    def cleanup(self, name: str) -> None:
        """Make an inactive controller unconfigured.

        Raises:
            ControllerError: it is not loaded or active.
        """
        record = self._record(name, "cleanup")
        if record.is_active:
            raise ControllerError(f"Controller '{name}' can not be cleaned-up from 'active' state.")
        self._unmake(record)

    def switch(
        self, start: Iterable[str] = (), stop: Iterable[str] = (), *, strict: bool = True
    ) -> tuple[str, ...]:
        """Stop and start controllers, in this order, at once.

        Resource conflicts are found before anything changes.

        Args:
            start: names of what to start; what is in `stop` too is restarted.
            stop: names of what to stop.
            strict: fail when anything asked for cannot be done; else leave it out.

        Returns:
            what was left out, in words.

        Raises:
            ControllerError: the switch cannot be done.
        """
        plan = plan_switch(
            self._records,
            start,
            stop,
            strict=strict,
            ros_version=self.robot.ros_version,
            check=self.robot.check_switch,
            refusal=self._refusal,
        )
        self._carry_out(plan)
        return tuple(plan.notes)

    def unload(self, name: str) -> None:
        """Forget a controller that does not run.

        Raises:
            ControllerError: it is not loaded, or it runs.
        """
        record = self._record(name, "unload")
        if record.is_active:
            word = "running" if self.robot.ros_version == 1 else "active"
            raise ControllerError(
                f"Could not unload controller with name '{name}' because it is still {word}"
            )
        self._unmake(record)
        record.state = ControllerState.FINALIZED
        del self._records[name]

    def unload_all(self, *, force: bool) -> None:
        """Unload everything, as reloading the libraries does.

        Raises:
            ControllerError: controllers are loaded and `force` is false.
        """
        if self._records and not force:
            raise ControllerError(
                "Controller manager: Cannot reload controller libraries because there are still "
                f"{len(self._records)} controllers running"
            )
        self.switch(stop=[record.name for record in self._running])
        for name in tuple(self._records):
            self.unload(name)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Run the control loop once: read, update every active controller, write.

        Controllers are updated in the order they were loaded, as in both originals. One that
        raises is stopped and reported; the others go on.
        """
        robot = self.robot
        self._time_ns = time_ns
        robot.read(time_ns, period_ns)
        for record in self._running:
            controller = record.controller
            if controller is None:
                continue
            period = period_ns
            if record.update_rate_hz != self.update_rate_hz:
                period = time_ns - record.last_update_ns
                # A hundredth of slack, as ros2_control has, against rounded periods.
                if period * record.update_rate_hz < 0.99 * NS_PER_S:
                    continue
                record.last_update_ns = time_ns
            try:
                controller.update(time_ns, period)
            except Exception as error:  # noqa: BLE001 - one controller must not stop the others
                self._fail(record, "update", error)
        robot.write(time_ns, period_ns)

    def reset(self) -> None:
        """Restart the active controllers: the world went back to its start, or an emergency ended.

        The hardware components have been reset before, where that is due.
        """
        now = self.now_ns
        active = self._running
        for record in active:
            self._call(record, "stop", now)
        self.robot.read(now, 0)
        for record in active:
            if record.is_active and self._call(record, "start", now):
                record.last_update_ns = now

    def close(self) -> None:
        """Stop and forget everything; closing twice does nothing."""
        running, self._running = self._running, ()
        for record in running:
            record.state = ControllerState.INACTIVE
            self._call(record, "stop", self.now_ns)
        for record in tuple(self._records.values()):
            self._unmake(record)
            record.state = ControllerState.FINALIZED
        self._records.clear()

    def _carry_out(self, plan: SwitchPlan) -> None:
        """Switch the hardware, then stop, then start, in the originals' order."""
        if not plan.start and not plan.stop:
            return
        now = self.now_ns
        self.robot.switch(plan.claims, plan.releases)
        for record in plan.stop:
            record.state = ControllerState.INACTIVE
            self._call(record, "stop", now)
        if plan.start:
            self.robot.read(now, 0)
        for record in plan.start:
            record.state, record.has_run, record.last_update_ns = ControllerState.ACTIVE, True, now
        self._list_running()
        failed = [record.name for record in plan.start if not self._call(record, "start", now)]
        if failed:
            raise ControllerError(f"Unable to activate controllers: [ {' '.join(failed)} ]")

    def _refusal(self, record: ControllerRecord) -> str:
        """Return why a controller cannot be activated, empty when its hardware is ready."""
        if record.controller is not None and record.controller.takes_all_states:
            return self.robot.lifecycle.refusal(record.name, record.commands, ())
        return self.robot.lifecycle.refusal(record.name, record.commands, record.states)

    def _make(self, record: ControllerRecord) -> None:
        self._maker.make(record)
        record.state = ControllerState.INACTIVE

    def _unmake(self, record: ControllerRecord) -> None:
        if record.controller is not None:
            record.controller.close()
        if record.ports is not None:
            record.ports.close()
        record.controller = record.ports = None
        record.state = ControllerState.UNCONFIGURED

    def _call(self, record: ControllerRecord, action: str, time_ns: int) -> bool:
        """Start or stop a controller; False when it raised, which stops it."""
        controller = record.controller
        if controller is None:
            return True
        try:
            (controller.start if action == "start" else controller.stop)(time_ns)
        except Exception as error:  # noqa: BLE001 - one controller must not stop the others
            self._fail(record, action, error)
            return False
        return True

    def _fail(self, record: ControllerRecord, action: str, error: Exception) -> None:
        text = f"controller '{record.name}' ({record.type}) failed in {action} at "
        text += f"{self.now_ns * 1e-9:.9f} s and is stopped: {_error_text(error)}"
        self.diagnostics.report("control.controller-failed", text)
        if record.ports is not None:
            record.ports.log("error", text)
        if record.is_active:
            record.state = ControllerState.INACTIVE
            self._list_running()
            self.robot.switch(frozenset(), frozenset(record.commands))
            if action == "update":
                self._call(record, "stop", self.now_ns)

    def _list_running(self) -> None:
        self._running = tuple(one for one in self._records.values() if one.is_active)

    def _record(self, name: str, verb: str) -> ControllerRecord:
        record = self._records.get(name)
        if record is not None:
            return record
        loaded = ", ".join(self._records) or "none"
        hint = did_you_mean(name, self._records) or f"loaded: {loaded}"
        raise ControllerError(
            f"Could not {verb} controller with name '{name}' because no controller with this name "
            f"exists; {hint}"
        )

    def _rate_of(self, name: str) -> float:
        """Return a controller's own rate, and say what of its wishes cannot be met."""
        tree = self.source.tree(name)
        if tree.get("is_async") is True:
            self._report(name, "is_async", "has no effect: controllers run in the control loop")
        value: Any = tree.get("update_rate", 0)
        if isinstance(value, bool) or not isinstance(value, int | float) or value <= 0:
            return self.update_rate_hz
        if value > self.update_rate_hz:
            text = f"is {value:g} Hz: the controller's update rate should be less than or equal to "
            text += f"controller manager's update rate : {self.update_rate_hz:g} Hz, which is used"
            self._report(name, "update_rate", text)
        return min(float(value), self.update_rate_hz)

    def _take_named(self, name: str) -> None:
        """Read what a spawner told of a controller before it was loaded."""
        from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource

        if isinstance(self.source, FileSource):
            self.source.take_named(name)

    def _report(self, name: str, key: str, text: str) -> None:
        full = self.source.full_name(name, key)
        message = f"controller '{name}': parameter '{full}' {text}"
        self.diagnostics.report("control.update-rate", message, self.source.span(name, key))


def _error_text(error: Exception) -> str:
    return str(error) if isinstance(error, ControllerError) else f"{type(error).__name__}: {error}"
