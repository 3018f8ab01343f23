"""Verbs of ``ros2 control`` that change something."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from gazelle.cli.ros_tool import ToolError
from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.nodes.controller_manager.client import BEST_EFFORT, STRICT, ManagerClient

__all__ = [
    "cleanup_controller",
    "load_controller",
    "reload_controller_libraries",
    "set_controller_state",
    "set_hardware_component_state",
    "switch_controllers",
    "unload_controller",
]

_LOGS = "check controller_manager logs"
_NEW_WORDS = {"start": "active", "configured": "inactive", "stop": "inactive"}
_STATE_IDS = {"unconfigured": 1, "inactive": 2, "active": 3}


def load_controller(client: ManagerClient, options: argparse.Namespace) -> int:
    """Load a controller, and configure and activate it when asked to."""
    name = options.controller_name
    if any(one.name == name for one in client.controllers()):
        print(f"Controller : {name} already loaded, skipping load_controller!")
    else:
        _set_file(client, name, options.param_file)
        if not client.load(name):
            raise ToolError(f"Failed loading controller {name} {_LOGS}")
        print(f"Successfully loaded controller {name}")
    wanted = _NEW_WORDS.get(options.set_state, options.set_state)
    if wanted is None:
        return 0
    if not client.configure(name):
        raise ToolError(f"Error configuring controller : {name}")
    if wanted == "active":
        answer = _switch(client, start=[name])
        if not answer.ok:
            raise ToolError(f"Error activating controller : {name}, {_LOGS}: {answer.message}")
    print(f"Successfully loaded controller {name} into state {wanted}")
    return 0


def set_controller_state(client: ManagerClient, options: argparse.Namespace) -> int:
    """Configure, activate, deactivate or clean up a controller."""
    name, wanted = options.controller_name, _NEW_WORDS.get(options.state, options.state)
    states = {one.name: one.state for one in client.controllers()}
    if name not in states:
        hint = did_you_mean(name, states) or f"loaded: {', '.join(states) or 'none'}"
        raise ToolError(f"controller {name} does not seem to be loaded; {hint}")
    step = _STEPS.get((states[name], wanted))
    if step is None:
        raise ToolError(f"cannot put {name} in '{wanted}' state from its current state "
                        f"{states[name]}")  # fmt: skip
    verb, done = step
    reason = _take_step(client, name, verb)
    if reason is not None:
        raise ToolError(f"Error {verb} controller, {_LOGS}{reason}")
    print(f"Successfully {done} {name}")
    return 0


def switch_controllers(client: ManagerClient, options: argparse.Namespace) -> int:
    """Activate some controllers and deactivate others."""
    if options.strict and options.best_effort:
        raise ToolError("argument --best-effort: not allowed with argument --strict")
    answer = client.switch(
        options.activate,
        options.deactivate,
        strictness=BEST_EFFORT if options.best_effort else STRICT,
        asap=options.activate_asap,
        switch_timeout_s=options.switch_timeout,
    )
    if not answer.ok:
        raise ToolError(f"Error switching controllers, {_LOGS}: {answer.message}")
    print(answer.message or "Successfully switched controllers")
    return 0


def unload_controller(client: ManagerClient, options: argparse.Namespace) -> int:
    """Unload a controller."""
    name = options.controller_name
    if not client.unload(name):
        raise ToolError(f"Error unloading controller {name}, {_LOGS}")
    print(f"Successfully unloaded controller {name}")
    return 0


def reload_controller_libraries(client: ManagerClient, options: argparse.Namespace) -> int:
    """Unload everything."""
    answer = client.call(
        "reload_controller_libraries", "ReloadControllerLibraries", force_kill=options.force_kill
    )
    if not answer.ok:
        raise ToolError(f"Error reloading libraries, {_LOGS}")
    print("Reload successful")
    return 0


def set_hardware_component_state(client: ManagerClient, options: argparse.Namespace) -> int:
    """Set the state of a block of hardware."""
    from gazelle.interfaces import message_type

    name, wanted = options.hardware_component_name, options.state
    found = client.call("list_hardware_components", "ListHardwareComponents").component
    states = {one.name: one.state.label for one in found}
    if name not in states:
        hint = did_you_mean(name, states) or f"there are: {', '.join(states) or 'none'}"
        raise ToolError(f"component {name} does not seem to be loaded; {hint}")
    step = _HARDWARE_STEPS.get((states[name], wanted))
    if step is None:
        raise ToolError(_no_step(name, states[name], wanted))
    state = message_type("lifecycle_msgs/State")(id=_STATE_IDS[wanted], label=wanted)
    answer = client.call(
        "set_hardware_component_state",
        "SetHardwareComponentState",
        name=name,
        target_state=state,
    )
    if not answer.ok:
        raise ToolError(f"Error {step} hardware component, {_LOGS}")
    print(f"Successfully set {name} to state {answer.state}")
    return 0


def cleanup_controller(client: ManagerClient, options: argparse.Namespace) -> int:
    """Make an inactive controller unconfigured."""
    name = options.controller_name
    if not client.call("cleanup_controller", "CleanupController", name=name).ok:
        raise ToolError(f"Error cleanup controllers, {_LOGS}")
    print(f"Successfully cleaned up controller {name}")
    return 0


# What leads from one state of hardware to another; the original's command takes no other ways.
_HARDWARE_STEPS = {
    ("unconfigured", "inactive"): "configuring",
    ("active", "inactive"): "stopping",
    ("inactive", "active"): "activating",
    ("inactive", "unconfigured"): "cleaning up",
}
_HARDWARE_VERBS = {"active": "activate", "unconfigured": "cleanup"}


def _no_step(name: str, state: str, wanted: str) -> str:
    verb = _HARDWARE_VERBS.get(wanted)
    what = f"cannot {verb} {name}" if verb else f'cannot put {name} in "{wanted}" state'
    text = f"{what} from its current state {state}"
    return text if state in (wanted, "inactive") else f"{text}; set it inactive first"


# What leads from one state to another: the verb, and the original's word when it is done.
_STEPS = {
    ("unconfigured", "inactive"): ("configuring", "configured"),
    ("active", "inactive"): ("stopping", "deactivated"),
    ("inactive", "active"): ("activating", "activated"),
    ("inactive", "unconfigured"): ("cleaning up", "cleaned up"),
}


def _take_step(client: ManagerClient, name: str, verb: str) -> str | None:
    """Return None when it is done, else what the manager says about it."""
    if verb == "configuring":
        return None if client.configure(name) else ""
    if verb == "cleaning up":
        done = client.call("cleanup_controller", "CleanupController", name=name).ok
        return None if done else ""
    names = [name]
    answer = _switch(client, start=names) if verb == "activating" else _switch(client, stop=names)
    return None if answer.ok else f": {answer.message}"


def _switch(client: ManagerClient, start: Any = (), stop: Any = ()) -> Any:
    return client.switch(start, stop, asap=True, switch_timeout_s=5.0)


def _set_file(client: ManagerClient, name: str, file: str | None) -> None:
    if file is None:
        return
    path = Path(file).resolve()
    if not path.is_file():
        raise ToolError(f"Controller parameter file : {file} does not exist, Aborting!")
    values: dict[str, Any] = {f"{name}.params_file": [str(path)]}
    found = FileSource([path], client.name.rpartition("/")[0], Diagnostics()).controller_type(name)
    if found is not None:
        values[f"{name}.type"] = found
    reason = client.set_parameters(values)
    if reason:
        raise ToolError(f"Could not set the parameters of {name}: {reason}")
