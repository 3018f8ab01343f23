"""States of hardware components: which of their interfaces there are, and who is read and written.

An unconfigured component has no interfaces, an inactive one is read only, an active one is written
too (ros2_control, ``hardware_component.cpp`` and ``resource_manager.cpp``, Humble to Rolling).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from enum import IntEnum

from gazelle.control.errors import ControllerError

__all__ = ["HardwareLifecycle", "HardwareState", "initial_states"]

_INITIAL = "hardware_components_initial_state"
# Humble's first names for the same.
_OLD = {"configure_components_on_start": "inactive", "activate_components_on_start": "active"}


class HardwareState(IntEnum):
    """``lifecycle_msgs/State`` of a component; `label` is its word."""

    UNCONFIGURED = 1
    INACTIVE = 2
    ACTIVE = 3
    FINALIZED = 4

    @property
    def label(self) -> str:
        """The word for it."""
        return self.name.lower()


class HardwareLifecycle:
    """The states of all components, which are active at first.

    Args:
        owners: component by the name of each interface; an interface of none is always there.

    Attributes:
        takes_inactive: controllers may claim commands of inactive components.
    """

    def __init__(self, owners: Mapping[str, str] | None = None) -> None:
        """Have everything active."""
        self.owners = dict(owners or {})
        self.takes_inactive = False
        self._states: dict[str, HardwareState] = {}

    def state(self, component: str) -> HardwareState:
        """Return the state of a component."""
        return self._states.get(component, HardwareState.ACTIVE)

    def reads(self, component: str) -> bool:
        """Tell whether its states are measured."""
        return self.state(component) in (HardwareState.INACTIVE, HardwareState.ACTIVE)

    def writes(self, component: str) -> bool:
        """Tell whether commands reach it."""
        return self.state(component) is HardwareState.ACTIVE

    def is_available(self, interface: str) -> bool:
        """Tell whether an interface is there."""
        owner = self.owners.get(interface)
        return owner is None or self.reads(owner)

    def available(self, interfaces: Iterable[str]) -> tuple[str, ...]:
        """Return those interfaces that are there."""
        return tuple(name for name in interfaces if self.is_available(name))

    def refusal(self, controller: str, commands: Iterable[str], states: Iterable[str]) -> str:
        """Return why a controller cannot be activated, empty when it can."""
        text = f"Could not activate controller '{controller}'"
        for kind, names in (("command", commands), ("state", states)):
            for name in names:
                owner = self.owners.get(name, "")
                if not self.is_available(name):
                    return (
                        f"{text}: {kind} interface with '{name}' is not available: hardware "
                        f"'{owner}' is {self.state(owner).label}; "
                        f"`ros2 control set_hardware_component_state {owner} inactive` first"
                    )
                if kind == "command" and owner and not self._takes_commands(owner):
                    return (
                        f"{text}: command interface '{name}' belongs to hardware '{owner}', "
                        f"which is inactive; `ros2 control set_hardware_component_state {owner}"
                        " active` first"
                    )
        return ""

    def _takes_commands(self, component: str) -> bool:
        return self.takes_inactive or self.writes(component)

    def set(self, component: str, wanted: HardwareState) -> None:
        """Bring a component into a state; what lies between is passed through.

        Raises:
            ControllerError: it is finalized.
        """
        if self.state(component) is HardwareState.FINALIZED:
            raise ControllerError(
                f"hardware '{component}' is in finalized state and can be only destroyed."
            )
        self._states[component] = wanted


def initial_states(
    tree: Mapping[str, object], components: Iterable[str]
) -> Iterator[tuple[str, HardwareState | None]]:
    """Yield the state that a manager's parameters give each component at first.

    Args:
        tree: the parameters, nested.
        components: the names there are.

    Yields:
        a name and its state; None for the state where there is no such component.
    """
    rest = dict.fromkeys(components)
    group = tree.get(_INITIAL)
    wishes = dict(group) if isinstance(group, Mapping) else {}
    first = [(label, wishes.get(label)) for label in ("unconfigured", "inactive")]
    if not wishes:
        first = [(label, tree.get(name)) for name, label in _OLD.items()]
    for label, names in first:
        for name in names if isinstance(names, list) else ():
            known = str(name) in rest
            rest.pop(str(name), None)
            yield str(name), HardwareState[label.upper()] if known else None
    # Who lists what is to be active does without the others.
    is_listed = not wishes and isinstance(tree.get("activate_components_on_start"), list)
    for name in rest:
        yield name, HardwareState.UNCONFIGURED if is_listed else HardwareState.ACTIVE
