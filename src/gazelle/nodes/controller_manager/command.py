"""``controller_manager list|load|start|stop|…`` of ROS 1, as a node and as a command."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace

from gazelle.diagnostics import did_you_mean
from gazelle.errors import GraphError
from gazelle.graph import Graph, Node
from gazelle.graph.names import anonymous_name
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.controller_manager.client import BEST_EFFORT, ManagerClient
from gazelle.nodes.parameters import start_node

__all__ = ["USAGE", "command", "run"]

USAGE = """Commands:
    load <name>          - Load the controller named <name>
    unload <name>        - Unload the controller named <name>
    start <name>         - Start the controller named <name>
    stop <name>          - Stop the controller named <name>
    spawn <name>         - Load and start the controller named <name>
    kill <name>          - Stop and unload the controller named <name>
    list                 - List active controllers
    list-types           - List controller Types
    reload-libraries     - Reloads all plugin controller libraries

Options:
    --namespace <ns>     - namespace of the controller manager
    --restore            - reload-libraries: load and start again what was there"""
_PROGRAMS = frozenset({"controller_manager", "pr2_controller_manager"})
_SHORT = {"lt": "list-types", "lc": "list", "sp": "spawn", "kl": "kill"}


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run one command and end."""
    if arguments.name in _PROGRAMS:
        # The manager itself may be called so.
        arguments = replace(arguments, name=anonymous_name("controller_manager"))
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: stop.set())
    try:
        return command(node, arguments.rest, stop, late=arguments.ready)
    finally:
        node.shutdown()


def command(
    node: Node,
    argv: Sequence[str],
    stop: threading.Event,
    *,
    late: Callable[[], None] = lambda: None,
) -> int:
    """Carry out a command over a node; prints what the original prints.

    Args:
        node: a started node of the graph.
        argv: the command, its controllers and options.
        stop: ends waiting for the manager.
        late: called when the manager lets itself be waited for.

    Returns:
        0, 1 for a failure, 2 for wrong words.
    """
    rest = list(argv)
    namespace = _option(rest, "--namespace")
    restore = "--restore" in rest
    names = [word for word in rest[1:] if not word.startswith("-")]
    verb = _SHORT.get(rest[0], rest[0]) if rest else ""
    action = _ACTIONS.get(verb)
    if action is None:
        _say(USAGE)
        if verb in {"", "-h", "--help"}:
            return 0
        hint = did_you_mean(verb, _ACTIONS)
        _complain(f"controller_manager: no command '{verb}'; {hint}".rstrip("; "))
        return 2
    manager = f"{namespace.rstrip('/')}/controller_manager" if namespace else "controller_manager"
    client = ManagerClient(node, manager, stop)
    try:
        anywhere = not namespace and node.namespace == "/"
        if not client.find(may_be_another=anywhere, late=late):
            return 1
        return 0 if action(client, names, restore) else 1
    except GraphError as error:
        _complain(f"ERROR: {error}")
        return 1


def _option(argv: list[str], name: str) -> str:
    """Take an option with its value out of the words."""
    for index, word in enumerate(argv):
        if word.startswith(f"{name}="):
            return argv.pop(index).partition("=")[2]
        if word == name and index + 1 < len(argv):
            del argv[index]
            return argv.pop(index)
    return ""


def _list(client: ManagerClient, _names: list[str], _restore: bool) -> bool:
    found = client.controllers()
    if not found:
        _say("No controllers are loaded in mechanism control")
    for one in found:
        interfaces = "+".join(_interfaces(one))
        _say(f"'{one.name}' - '{interfaces}' ( {one.state} )")
    return True


def _interfaces(state: object) -> list[str]:
    """Return hardware interfaces of ROS 1, command interfaces of ROS 2."""
    claimed = getattr(state, "claimed_resources", None)
    if claimed is not None:
        return list(dict.fromkeys(one.hardware_interface for one in claimed))
    return list(getattr(state, "claimed_interfaces", ()))


def _list_types(client: ManagerClient, _names: list[str], _restore: bool) -> bool:
    for name in client.call("list_controller_types", "ListControllerTypes").types:
        _say(name)
    return True


def _load(client: ManagerClient, names: list[str], _restore: bool) -> bool:
    good = True
    for name in names:
        done = client.load(name) and client.configure(name)
        _say(f"Loaded '{name}'" if done else f"Error when loading '{name}'")
        good = good and done
    return good


def _unload(client: ManagerClient, names: list[str], _restore: bool) -> bool:
    good = True
    for name in names:
        done = client.unload(name)
        _say(f"Unloaded '{name}' successfully" if done else f"Error when unloading '{name}'")
        good = good and done
    return good


def _start(client: ManagerClient, names: list[str], _restore: bool) -> bool:
    done = [_switch(client, [name], []) for name in names]
    return all(done)


def _stop(client: ManagerClient, names: list[str], _restore: bool) -> bool:
    done = [_switch(client, [], [name]) for name in names]
    return all(done)


def _switch(client: ManagerClient, start: list[str], stop: list[str]) -> bool:
    if not client.switch(start, stop).ok:
        _say(f"Error when starting {start} and stopping {stop}")
        return False
    for word, names in (("Started", start), ("Stopped", stop)):
        if names:
            _say(f"{word} {names} successfully")
    return True


def _spawn(client: ManagerClient, names: list[str], restore: bool) -> bool:
    loaded = _load(client, names, restore)
    return _start(client, names, restore) and loaded


def _kill(client: ManagerClient, names: list[str], restore: bool) -> bool:
    stopped = _stop(client, names, restore)
    return _unload(client, names, restore) and stopped


def _reload(client: ManagerClient, _names: list[str], restore: bool) -> bool:
    before = client.controllers() if restore else ()
    _say(f"Restore: {restore}")
    done = client.call("reload_controller_libraries", "ReloadControllerLibraries", force_kill=True)
    if done.ok:
        _say("Successfully reloaded libraries")
    else:
        _say("Failed to reload libraries. Do you still have controllers loaded?")
    if restore:
        for one in before:
            client.load(one.name)
        running = [one.name for one in before if one.state == "running"]
        client.switch(running, strictness=BEST_EFFORT)
        _say("Controllers restored to original state")
    return bool(done.ok)


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def _complain(text: str) -> None:
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()


_ACTIONS: dict[str, Callable[[ManagerClient, list[str], bool], bool]] = {
    "load": _load,
    "unload": _unload,
    "start": _start,
    "stop": _stop,
    "spawn": _spawn,
    "kill": _kill,
    "list": _list,
    "list-types": _list_types,
    "reload-libraries": _reload,
}
