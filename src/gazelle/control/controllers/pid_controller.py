"""ROS 2's pid_controller."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.control.angles import shortest_angular_distance
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array, Indices
from gazelle.control.pid import Pid, PidGains, PidStatePort, offer_live_gains, read_gains
from gazelle.control.pid.gains import gain_rows
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["PID_CONTROLLER_TABLE", "PidController"]


_ONLY = (2,)


def _row(
    key: str, kind: ParameterKind, default: object, meaning: str, *, live: bool = False
) -> Parameter:
    return Parameter(key, kind, default, meaning, live=live, ros_versions=_ONLY)


PID_CONTROLLER_TABLE = ControllerTable(
    ParameterTable(
        "pid_controller",
        "A PID for each degree of freedom, from references on a topic to any command interface.",
        ("pid_controller/PidController",),
        (
            _row("dof_names", "texts", None, "whose command_interface is claimed; required"),
            _row(
                "reference_and_state_dof_names",
                "texts",
                (),
                "whose state is read; dof_names if empty",
            ),
            _row("command_interface", "text", None, "what is commanded; required"),
            _row(
                "reference_and_state_interfaces",
                "texts",
                None,
                "a state, or it and its rate; required",
            ),
            _row("set_current_state_as_first_setpoint", "flag", True, "hold where it begins"),
            _row("use_external_measured_states", "flag", False, "states come on ~/measured_state"),
            _row("enable_feedforward", "flag", False, "use feedforward_gain", live=True),
            *gain_rows("gains.<dof>", _ONLY),
            _row("gains.<dof>.feedforward_gain", "number", 0.0, "times the reference", live=True),
            _row(
                "gains.<dof>.angle_wraparound",
                "flag",
                False,
                "take the shorter way round",
                live=True,
            ),
            _row("gains.<dof>.save_i_term", "flag", True, "keep the integral over a restart"),
            _row("gains.<dof>.activate_state_publisher", "flag", False, "offer ~/<dof>/pid_state"),
            _row(
                "gains.<dof>.saturation",
                "refused",
                None,
                "u_clamp_max and u_clamp_min alone decide",
            ),
        ),
    ),
    interfaces="claims command_interface of dof_names; reads the interfaces of the references",
    topics=(
        Topic("~/reference", "control_msgs/MultiDOFCommand", "listens", ros_versions=_ONLY),
        Topic(
            "~/measured_state",
            "control_msgs/MultiDOFCommand",
            "listens",
            "with use_external_measured_states",
            ros_versions=_ONLY,
        ),
        Topic(
            "~/controller_state",
            "control_msgs/MultiDOFStateStamped",
            rate="every update",
            ros_versions=_ONLY,
        ),
        Topic(
            "~/<dof>/pid_state",
            "control_msgs/PidState",
            rate="every update, with activate_state_publisher",
            ros_versions=_ONLY,
        ),
        Topic("~/set_feedforward_control", "std_srvs/SetBool", "service", ros_versions=_ONLY),
    ),
    behaviour=(
        "With two interfaces the rate's error is what d acts on, once a reference of the rate is "
        "known (pid_controller.cpp).",
        "Nothing is commanded of a degree of freedom while its reference or state is unknown.",
        "References stay until the next; NaN in a message leaves one as it is.",
        "It cannot be chained: references come on the topic.",
    ),
)


class PidController(Controller):
    """A PID per degree of freedom, from one or two state interfaces to one command interface."""

    TABLE = PID_CONTROLLER_TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Look up interfaces and gains."""
        super().__init__(context)
        parameters = context.parameters
        for key in ("dof_names", "command_interface", "reference_and_state_interfaces"):
            parameters.require(key)
        self._dofs = parameters.texts("dof_names")
        self._owners = parameters.texts("reference_and_state_dof_names") or self._dofs
        interfaces = parameters.texts("reference_and_state_interfaces")
        self._check(interfaces)
        self._has_rates = len(interfaces) == 2
        self._interface = interfaces[0]
        self._is_external = parameters.flag("use_external_measured_states")
        command = parameters.text("command_interface")
        self.commands = tuple(f"{dof}/{command}" for dof in self._dofs)
        self._indices = context.command_indices(self.commands).tolist()
        self._state_indices: Indices | None = None
        if not self._is_external:
            self.states = tuple(f"{dof}/{word}" for word in interfaces for dof in self._owners)
            self._state_indices = context.state_indices(self.states)
        count = len(self._dofs) * len(interfaces)
        self._reference: Array = np.full(count, math.nan)
        self._measured: Array = np.full(count, math.nan)
        self._read_gains()
        self._open()

    def start(self, time_ns: int) -> None:
        """Begin with the present state as reference, unless told otherwise."""
        self._reference[:] = math.nan
        parameters = self.context.parameters
        if parameters.flag("set_current_state_as_first_setpoint"):
            self._measure()
            self._reference[:] = self._measured
        if self._is_external:
            self._measured[:] = math.nan
        for dof, pid in zip(self._dofs, self.pids, strict=True):
            pid.reset(keeps_integral=parameters.flag(f"gains.{dof}.save_i_term"))

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PIDs want of each degree of freedom that has reference and state."""
        self._measure()
        period_s = period_ns * 1e-9
        for k in range(len(self.pids)):
            self._update_one(k, time_ns, period_ns, period_s)
        if self._publisher.matched:
            self._publisher.publish(self._state(time_ns, period_s))

    def changed(self, values: dict[str, Any]) -> str:
        """Take over feed-forward gains and wrap-around; the PIDs' gains come by themselves."""
        for key, value in values.items():
            group, _, rest = key.partition(".")
            dof, _, word = rest.rpartition(".")
            if group != "gains" or dof not in self._dofs:
                continue
            index = self._dofs.index(dof)
            if word == "feedforward_gain":
                self._feedforward[index] = float(value)
            elif word == "angle_wraparound":
                self._wraps[index] = bool(value)
        if "enable_feedforward" in values:
            self._is_fed_forward = bool(values["enable_feedforward"])
        return ""

    def _check(self, interfaces: tuple[str, ...]) -> None:
        dofs, owners = len(self._dofs), len(self._owners)
        text = ""
        if not self._dofs or len(set(self._dofs)) != dofs:
            text = "'dof_names' must be different names, at least one"
        elif dofs != owners:
            text = f"Size of 'dof_names' ({dofs}) and 'reference_and_state_dof_names' ({owners}) "
            text += "parameters has to be the same!"
        elif not 1 <= len(interfaces) <= 2:
            text = "'reference_and_state_interfaces' must be one interface, or it and its rate"
        if text:
            raise ControllerError(f"{self.context.name}: {text}")

    def _read_gains(self) -> None:
        context, parameters = self.context, self.context.parameters
        gains = [read_gains(parameters, "gains", dof, ros_version=2) for dof in self._dofs]
        self.pids = [Pid(PidGains() if row is None else row) for row in gains]
        self._pid_states: dict[int, PidStatePort] = {}
        for k, (dof, pid) in enumerate(zip(self._dofs, self.pids, strict=True)):
            offer_live_gains(context, f"gains.{dof}", pid)
            if parameters.flag(f"gains.{dof}.activate_state_publisher"):
                self._pid_states[k] = PidStatePort(context.ports, f"~/{dof}/pid_state")
        self._feedforward = [parameters.number(f"gains.{d}.feedforward_gain") for d in self._dofs]
        self._wraps = [parameters.flag(f"gains.{dof}.angle_wraparound") for dof in self._dofs]
        # Later releases have no switch: there a gain of its own feeds forward.
        self._is_fed_forward = parameters.flag("enable_feedforward")

    def _open(self) -> None:
        ports = self.context.ports
        ports.subscription("~/reference", "control_msgs/MultiDOFCommand", self._take_reference)
        if self._is_external:
            ports.subscription(
                "~/measured_state", "control_msgs/MultiDOFCommand", self._take_measured
            )
        ports.service("~/set_feedforward_control", "std_srvs/SetBool", self._set_feedforward)
        self._publisher = ports.publisher("~/controller_state", "control_msgs/MultiDOFStateStamped")

    def _measure(self) -> None:
        if self._state_indices is not None:
            self._measured = self.robot.interface_values.states[self._state_indices]

    def _update_one(self, k: int, time_ns: int, period_ns: int, period_s: float) -> None:
        reference, measured = self._reference.item(k), self._measured.item(k)
        if not (math.isfinite(reference) and math.isfinite(measured)):
            return
        error, rate, pid = self._error(k), self._rate_error(k), self.pids[k]
        if math.isfinite(rate):
            command = pid.compute_with_rate(error, rate, period_s)
        else:
            command = pid.compute(error, period_s)
        if self._is_fed_forward:
            lead = self._reference.item(len(self.pids) + k) if self._has_rates else reference
            command += lead * self._feedforward[k] if math.isfinite(lead) else 0.0
        interface_values = self.robot.interface_values
        interface_values.commands[self._indices[k]] = command
        if not self._is_external:
            interface_values.answer(int(self._indices[k]), *self._answers(pid.gains))
        if k in self._pid_states:
            self._pid_states[k].publish(pid, time_ns, period_ns)

    def _answers(self, gains: PidGains) -> tuple[float, float]:
        """Return what a command loses per position and per velocity of its joint."""
        if self._interface == "position":
            return gains.p, gains.d
        return (0.0, gains.p) if self._interface == "velocity" else (0.0, 0.0)

    def _error(self, k: int) -> float:
        reference, measured = self._reference.item(k), self._measured.item(k)
        if self._wraps[k] and math.isfinite(reference) and math.isfinite(measured):
            return shortest_angular_distance(measured, reference)
        return reference - measured

    def _rate_error(self, k: int) -> float:
        if not self._has_rates:
            return math.nan
        index = len(self.pids) + k
        return self._reference.item(index) - self._measured.item(index)

    def _state(self, time_ns: int, period_s: float) -> Any:
        message = stamped("control_msgs/MultiDOFStateStamped", time_ns)
        one = message_type("control_msgs/SingleDOFState")
        count = len(self.pids)
        for k, owner in enumerate(self._owners):
            state = one(name=owner, reference=self._reference.item(k))
            state.feedback, state.error = self._measured.item(k), self._error(k)
            if self._has_rates:
                state.feedback_dot = self._measured.item(count + k)
                state.error_dot = self._rate_error(k)
            state.time_step = period_s
            state.output = self.robot.interface_values.commands.item(self._indices[k])
            message.dof_states.append(state)
        return message

    def _take_reference(self, message: Any) -> None:
        values = self._sorted(message)
        if values is None:
            return
        count = len(self.pids)
        given = ~np.isnan(values[:count])
        self._reference[:count][given] = values[:count][given]
        if self._has_rates:
            given &= ~np.isnan(values[count:])
            self._reference[count:][given] = values[count:][given]

    def _take_measured(self, message: Any) -> None:
        values = self._sorted(message)
        if values is not None:
            self._measured = values[: len(self._measured)]

    def _sorted(self, message: Any) -> Array | None:
        """Return values and rates in the order of the degrees of freedom, None if refused."""
        names, count = list(message.dof_names) or list(self._owners), len(self._owners)
        values = np.asarray(message.values, dtype=np.float64)
        rates = np.asarray(message.values_dot, dtype=np.float64)
        text = ""
        if len(names) != count or len(values) != count or len(rates) not in {0, count}:
            text = f"Size of input data names ({len(message.dof_names)}) and/or values "
            text += f"({len(values)}) is not matching the expected size ({count})."
        elif missing := next((name for name in self._owners if name not in names), ""):
            text = f"DoF name '{missing}' not found in the message; there are {', '.join(names)}"
        if text:
            self.context.ports.log("error", f"{self.context.name}: {text}")
            return None
        order = [names.index(name) for name in self._owners]
        rates = rates if len(rates) else np.full(count, math.nan)
        return np.concatenate([values[order], rates[order]])

    def _set_feedforward(self, request: Any, response: Any) -> None:
        self._is_fed_forward = bool(request.data)
        response.success = True
