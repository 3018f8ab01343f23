"""Verbs of ``ros2 control`` that list, in the layout of the original."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterable
from typing import Any

from gazelle.nodes.controller_manager.client import ManagerClient

__all__ = [
    "list_controller_types",
    "list_controllers",
    "list_hardware_components",
    "list_hardware_interfaces",
]

_COLOURS = {
    "active": "\033[92m",
    "inactive": "\033[96m",
    "unconfigured": "\033[93m",
    "claimed": "\033[94m",
    "unclaimed": "\033[96m",
}
_END = "\033[0m"


def list_controllers(client: ManagerClient, options: argparse.Namespace) -> int:
    """Print the loaded controllers."""
    found = client.controllers()
    if not found:
        print("No controllers are currently loaded!")
        return 0
    widths = [max(len(getattr(one, key)) for one in found) for key in ("name", "type", "state")]
    for one in found:
        name, state = f"{one.name:<{widths[0]}}", f"{one.state:<{widths[2]}}"
        colour = one.state
        print(f"{_coloured(name, colour)} {one.type:<{widths[1]}}  {_coloured(state, colour)}")
        _print_details(one, options)
    return 0


def list_controller_types(client: ManagerClient, options: argparse.Namespace) -> int:
    """Print what can be loaded."""
    answer = client.call("list_controller_types", "ListControllerTypes")
    for name, base in zip(answer.types, answer.base_classes, strict=False):
        print(f"{name:70s} {base}")
    return 0


def list_hardware_interfaces(client: ManagerClient, options: argparse.Namespace) -> int:
    """Print command and state interfaces."""
    answer = client.call("list_hardware_interfaces", "ListHardwareInterfaces")
    print("command interfaces")
    for one in _sorted(answer.command_interfaces):
        claimed = "claimed" if one.is_claimed else "unclaimed"
        available = "available" if one.is_available else "unavailable"
        text = f"{one.name}{_data_type(one, options)} [{available}] [{claimed}]"
        print(f"\t{_coloured(text, claimed)}")
    print("state interfaces")
    for one in _sorted(answer.state_interfaces):
        print(f"\t{one.name}{_data_type(one, options)}")
    return 0


def list_hardware_components(client: ManagerClient, options: argparse.Namespace) -> int:
    """Print the blocks of hardware."""
    answer = client.call("list_hardware_components", "ListHardwareComponents")
    for number, one in enumerate(answer.component, 1):
        label = one.state.label
        print(f"Hardware Component {number}\n\tname: {_coloured(one.name, label)}")
        print(f"\ttype: {one.type}\n\tplugin name: {one.plugin_name}")
        print(f"\tstate: id={one.state.id} label={_coloured(label, label)}")
        print(f"\tread/write rate: {one.rw_rate} Hz\n\tis_async: {one.is_async}")
        print("\tcommand interfaces")
        for item in one.command_interfaces:
            claimed = _coloured("[claimed]", "claimed") if item.is_claimed else "[unclaimed]"
            print(f"\t\t{item.name}{_data_type(item, options)} {_available(item)} {claimed}")
        if options.verbose:
            print("\tstate interfaces")
            for item in one.state_interfaces:
                print(f"\t\t{item.name}{_data_type(item, options)} {_available(item)}")
    return 0


def _print_details(one: Any, options: argparse.Namespace) -> None:
    if options.verbose:
        print(f"\tupdate_rate: {one.update_rate} Hz\n\tis_async: {one.is_async}")
    chained = [name for link in one.chain_connections for name in link.reference_interfaces]
    for wanted, title, names in (
        (options.claimed_interfaces, "claimed interfaces", one.claimed_interfaces),
        (
            options.required_command_interfaces,
            "required command interfaces",
            one.required_command_interfaces,
        ),
        (
            options.required_state_interfaces,
            "required state interfaces",
            one.required_state_interfaces,
        ),
        (options.chained_interfaces, "chained to interfaces", chained),
        (options.exported_interfaces, "exported reference interfaces", one.reference_interfaces),
        (options.exported_interfaces, "exported state interfaces", one.exported_state_interfaces),
    ):
        if wanted or options.verbose:
            print(f"\t{title}:")
            for name in names:
                print(f"\t\t{name}")


def _sorted(interfaces: Iterable[Any]) -> list[Any]:
    return sorted(interfaces, key=lambda one: one.name)


def _available(one: Any) -> str:
    if one.is_available:
        return _coloured("[available]", "claimed")
    return _coloured("[unavailable]", "unconfigured")


def _data_type(one: Any, options: argparse.Namespace) -> str:
    return f" [{one.data_type}]" if options.verbose else ""


def _coloured(text: str, kind: str) -> str:
    """Colour words on a terminal, or where RCUTILS_COLORIZED_OUTPUT asks for it."""
    wish = os.environ.get("RCUTILS_COLORIZED_OUTPUT", "")
    wanted = wish == "1" or (wish != "0" and sys.stdout.isatty())
    return f"{_COLOURS[kind]}{text}{_END}" if wanted and kind in _COLOURS else text
