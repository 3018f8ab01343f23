"""``ros2 control view_controller_chains``: a graphviz picture of who reads and commands what.

Layout, names of nodes and of the file are those of ros2controlcli.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from gazelle.cli.ros_tool import ToolError
from gazelle.nodes.controller_manager.client import ManagerClient

__all__ = ["diagram", "view_controller_chains"]

_NAME = "controller_diagram"
_STATES, _COMMANDS = "state_interfaces", "command_interfaces"
_RENDER_S = 60.0

Port = tuple[str, str]


def view_controller_chains(client: ManagerClient, options: argparse.Namespace) -> int:
    """Save the diagram: as a PDF where graphviz is there, else as its source.

    Raises:
        ToolError: it cannot be written or drawn.
    """
    components = client.call("list_hardware_components", "ListHardwareComponents").component
    folder = Path.cwd() if options.save else Path(tempfile.gettempdir())
    source = folder / f"{_NAME}.gv"
    try:
        source.write_text(diagram(client.controllers(), components), encoding="utf-8")
    except OSError as error:
        raise ToolError(f"could not write {source}: {error.strerror}") from error
    dot = shutil.which("dot")
    if dot is None:
        print(f"Saved controller diagram to {source}")
        print("graphviz is not installed, so it is no picture yet: dot -Tpdf draws one")
        return 0
    picture = source.with_suffix(".gv.pdf" if not options.save else ".pdf")
    command = [dot, "-Tpdf", "-o", str(picture), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=_RENDER_S, check=False)
    if done.returncode:
        raise ToolError(f"dot could not draw {source}: {done.stderr.strip()}")
    if options.save:
        source.unlink()
    print(f"Saved controller diagram to {picture}")
    return 0


def diagram(controllers: Iterable[Any], components: Iterable[Any]) -> str:
    """Return the source of the diagram.

    Args:
        controllers: ``ControllerState`` of each.
        components: ``HardwareComponentState`` of each.
    """
    loaded = sorted(controllers, key=lambda one: str(one.name))
    hardware = list(components)
    # A chained interface is known to others by the name of its controller and its own.
    references = {f"{one.name}/{name}": one.name for one in loaded
                  for name in one.reference_interfaces}  # fmt: skip
    exported = {f"{one.name}/{name}": one.name for one in loaded
                for name in one.exported_state_interfaces}  # fmt: skip
    lines = [
        "digraph g {",
        '\tgraph [rankdir="LR" ranksep="2"]',
        '\tnode [shape="record" style="rounded"]',
    ]
    lines += [_controller(one, references, exported) for one in loaded]
    states, commands = (
        sorted({item.name for one in hardware for item in getattr(one, kind)})
        for kind in (_STATES, _COMMANDS)
    )
    lines.append(
        _node(_STATES, f"hw {_STATES}", [(f"state_start_{name}", name) for name in states])
    )
    lines.append(
        _node(_COMMANDS, f"hw {_COMMANDS}", [(f"command_end_{name}", name) for name in commands])
    )
    for one in loaded:
        lines += [
            _edge(_source_of(name, exported), (one.name, f"state_end_{name}"))
            for name in sorted(one.required_state_interfaces)
        ]
        lines += [
            _edge((one.name, f"command_start_{name}"), _target_of(name, references))
            for name in sorted(one.required_command_interfaces)
        ]
    return "\n".join([*lines, "}", ""])


def _controller(one: Any, references: dict[str, str], exported: dict[str, str]) -> str:
    inputs = [
        (f"state_end_{name}", f"{name} ({'exp state' if name in exported else 'state'})")
        for name in sorted(one.required_state_interfaces, key=lambda name: (name in exported, name))
    ]
    inputs += [
        (f"controller_end_{one.name}/{name}", f"{name} (exp ref)")
        for name in sorted(one.reference_interfaces)
    ]
    outputs = [
        (f"command_start_{name}", f"{name} (cmd)")
        for name in sorted(
            one.required_command_interfaces, key=lambda name: (name in references, name)
        )
    ]
    outputs += [
        (f"controller_start_{one.name}/{name}", f"{name} (exp state)")
        for name in sorted(one.exported_state_interfaces)
    ]
    return _node(one.name, one.name, inputs, outputs)


def _source_of(name: str, exported: dict[str, str]) -> Port:
    if name in exported:
        return exported[name], f"controller_start_{name}"
    return _STATES, f"state_start_{name}"


def _target_of(name: str, references: dict[str, str]) -> Port:
    if name in references:
        return references[name], f"controller_end_{name}"
    return _COMMANDS, f"command_end_{name}"


def _node(name: str, title: str, *columns: Sequence[Port]) -> str:
    groups = [
        "{" + " | ".join(f"<{port}> {text}" for port, text in column) + "}"
        for column in columns
        if column
    ]
    label = f"{title}|{{{'|'.join(groups)}}}" if groups else title
    return f'\t"{name}" [label="{label}"]'


def _edge(start: Port, end: Port) -> str:
    return f'\t"{start[0]}":"{start[1]}" -> "{end[0]}":"{end[1]}"'
