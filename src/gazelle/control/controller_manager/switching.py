"""Decides a switch of controllers before anything changes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

from gazelle.control.controller_manager.controller_spec import ControllerRecord, ControllerState
from gazelle.control.errors import ControllerError
from gazelle.diagnostics import did_you_mean

__all__ = ["SwitchPlan", "plan_switch"]

Refusal = Callable[[ControllerRecord], str]
Check = Callable[[frozenset[str], frozenset[str]], str]


@dataclass(slots=True)
class SwitchPlan:
    """What a switch comes to.

    Attributes:
        start: controllers to start, in the order asked for.
        stop: controllers to stop before.
        notes: what was asked for and is left out (best effort).
    """

    start: list[ControllerRecord] = field(default_factory=list)
    stop: list[ControllerRecord] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def claims(self) -> frozenset[str]:
        """Command interfaces that the started controllers claim."""
        return frozenset(name for record in self.start for name in record.commands)

    @property
    def releases(self) -> frozenset[str]:
        """Command interfaces that the stopped controllers give back."""
        return frozenset(name for record in self.stop for name in record.commands)


def plan_switch(
    records: Mapping[str, ControllerRecord],
    start: Iterable[str],
    stop: Iterable[str],
    *,
    strict: bool,
    ros_version: int,
    check: Check,
    refusal: Refusal = lambda record: "",
) -> SwitchPlan:
    """Return what to start and stop.

    Args:
        records: the loaded controllers.
        start: names of what to start; what is in `stop` too is restarted.
        stop: names of what to stop.
        strict: anything that cannot be done fails the whole switch; else it is left out.
        ros_version: 1 lets one controller at a time have a joint, 2 an interface of a joint.
        check: asks the hardware, with what is claimed and released.
        refusal: why a controller cannot be activated now, empty when it can.

    Raises:
        ControllerError: the switch cannot be done; nothing has changed.
    """
    planner = _Planner(records, refusal, strict=strict, ros_version=ros_version)
    plan = planner.plan(tuple(dict.fromkeys(start)), tuple(dict.fromkeys(stop)))
    reason = check(plan.claims, plan.releases) if plan.start or plan.stop else ""
    if reason:
        prefixes = {
            1: "Could not switch controllers. The hardware interface combination for the requested "
            "controllers is unfeasible.",
            2: "Could not switch controllers since prepare command mode switch was rejected.",
        }
        raise ControllerError(f"{prefixes[ros_version]} {reason}")
    return plan


class _Planner:
    def __init__(
        self,
        records: Mapping[str, ControllerRecord],
        refusal: Refusal,
        *,
        strict: bool,
        ros_version: int,
    ) -> None:
        self._records, self._refusal = records, refusal
        self._strict = strict
        self._ros_version = ros_version
        self._verbs = ("start", "stop") if ros_version == 1 else ("activate", "deactivate")
        self._plan = SwitchPlan()

    def plan(self, start: tuple[str, ...], stop: tuple[str, ...]) -> SwitchPlan:
        plan = self._plan
        plan.stop += [record for name in stop if (record := self._stopped(name)) is not None]
        plan.start += [
            record for name in start if (record := self._started(name, stop)) is not None
        ]
        self._resolve_conflicts()
        return plan

    def _stopped(self, name: str) -> ControllerRecord | None:
        record = self._known(name, self._verbs[1])
        if record is None or record.is_active:
            return record
        word = "running" if self._ros_version == 1 else "active"
        self._leave_out(f"Could not {self._verbs[1]} controller '{name}' since it is not {word}")
        return None

    def _started(self, name: str, stop: tuple[str, ...]) -> ControllerRecord | None:
        record = self._known(name, self._verbs[0])
        if record is None:
            return None
        if record.state is ControllerState.UNCONFIGURED:
            text = f"Could not activate controller '{name}': it is unconfigured, not inactive; "
            self._leave_out(text + "configure it first")
            return None
        if record.is_active and name not in stop:
            word = "running" if self._ros_version == 1 else "active"
            self._leave_out(f"Controller '{name}' is already {word}")
            return None
        reason = self._refusal(record)
        if reason:
            self._leave_out(reason)
            return None
        return record

    def _known(self, name: str, verb: str) -> ControllerRecord | None:
        record = self._records.get(name)
        if record is not None:
            return record
        text = f"Could not {verb} controller with name '{name}' because no controller with this "
        text += "name exists"
        loaded = ", ".join(self._records) or "none"
        hint = did_you_mean(name, self._records) or f"loaded: {loaded}"
        self._leave_out(f"{text}; {hint}")
        return None

    def _leave_out(self, text: str) -> None:
        if self._strict:
            raise ControllerError(text)
        self._plan.notes.append(text)

    def _resolve_conflicts(self) -> None:
        """Ros_control fails on any conflict; ros2_control's best effort drops the controller."""
        stopped = set(map(id, self._plan.stop))
        owners: dict[str, list[str]] = {}
        for record in self._records.values():
            if record.is_active and id(record) not in stopped:
                self._claim(record, owners)
        kept = []
        for record in self._plan.start:
            taken = {item: owners[item] for item in self._resources(record) if item in owners}
            if taken and (self._strict or self._ros_version == 1):
                raise ControllerError(self._conflict(record, taken))
            if taken:
                self._plan.notes.append(self._conflict(record, taken))
                continue
            self._claim(record, owners)
            kept.append(record)
        self._plan.start = kept

    def _claim(self, record: ControllerRecord, owners: dict[str, list[str]]) -> None:
        for item in self._resources(record):
            owners.setdefault(item, []).append(record.name)

    def _resources(self, record: ControllerRecord) -> tuple[str, ...]:
        if self._ros_version == 2:
            return record.commands
        return tuple(dict.fromkeys(name.rpartition("/")[0] for name in record.commands))

    def _conflict(self, record: ControllerRecord, taken: dict[str, list[str]]) -> str:
        if self._ros_version == 1:
            each = []
            for item, names in taken.items():
                owners = ", ".join([*names, record.name])
                each.append(f"Resource conflict on [{item}].  Controllers = [{owners}]")
            return "Could not switch controllers, due to resource conflict: " + "; ".join(each)
        item, names = next(iter(taken.items()))
        text = f"Resource conflict for controller '{record.name}'. Command interface '{item}' is "
        return text + f"already claimed by '{names[0]}' (Resource '{item}' already claimed)"
