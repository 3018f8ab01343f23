"""``joy joy_node``: a joystick's axes and buttons on ``joy``.

Without a joystick it says so once and looks for one every second; the same when one is pulled out.
Times are wall time, as hands are. Names and rules are those of joystick_drivers (noetic, ros2).
"""

from __future__ import annotations

import os
import select
import threading
import time
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.joy.device import (
    EVENT_BYTES,
    JoyState,
    devices,
    name_of,
    open_device,
    read_event,
)
from gazelle.nodes.joy.parameters import JoyOptions, read_options
from gazelle.nodes.parameters import log_findings, parameter_tree, start_node

__all__ = ["list_devices", "run"]

_RETRY_S = 1.0
# A node hears that it has to stop within this time.
_LOOK_S = 0.1


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Send what a joystick does until told to stop."""
    node = start_node(arguments, graph)
    tree = parameter_tree(node, arguments)
    found = Diagnostics()
    options = read_options(tree, node.name, arguments.ros_version, found)
    log_findings(node, found)
    joystick = _Joystick(node, options)
    arguments.ready()
    is_told = False
    while not stop.is_set():
        descriptor = joystick.open()
        if descriptor is None:
            if not is_told:
                node.log("error", joystick.absence)
            is_told = True
            stop.wait(_RETRY_S)
            continue
        is_told = False
        try:
            joystick.follow(descriptor, stop)
        finally:
            os.close(descriptor)
        if not stop.is_set():
            node.log("error", "Connection to joystick device lost unexpectedly. Will reopen.")
            is_told = True
            stop.wait(_RETRY_S)
    node.shutdown()
    return 0


def list_devices(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``joy_enumerate_devices``: print the joysticks there are."""
    del arguments, graph, stop
    lines = ["ID : Device                           : Joystick Device Name", "-" * 79]
    lines += [
        f"{number:2} : {device.path!s:32} : {device.name}"
        for number, device in enumerate(devices())
    ]
    print("\n".join(lines))  # noqa: T201 - it is a command
    return 0


class _Joystick:
    def __init__(self, node: Node, options: JoyOptions) -> None:
        self._node, self._options = node, options
        self._message: Any = message_type("sensor_msgs/msg/Joy")
        self._out = node.create_publisher("joy", self._message, queue_size=10)

    @property
    def absence(self) -> str:
        """What is said when there is none."""
        wanted = self._options.device_name
        which = f"with name {wanted}" if wanted else str(self._options.path)
        there = ", ".join(f"{one.path} ({one.name})" for one in devices()) or "none"
        return (
            f"Couldn't open joystick {which}. Will retry every second.\n"
            f"  Joysticks that can be read here: {there}. Without one, `ros2 run "
            "teleop_twist_keyboard teleop_twist_keyboard` drives by keys."
        )

    def open(self) -> int | None:
        """Return a descriptor of the device, None when there is none."""
        path = self._path()
        if path is None:
            return None
        try:
            descriptor = open_device(path)
        except OSError:
            return None
        name, deadzone = name_of(descriptor), self._options.deadzone
        self._node.log("info", f"Opened joystick: {path} ({name}). deadzone_: {deadzone:f}.")
        return descriptor

    def _path(self) -> Path | None:
        wanted = self._options.device_name
        if not wanted:
            return self._options.path
        return next((one.path for one in devices() if one.name == wanted), None)

    def follow(self, descriptor: int, stop: threading.Event) -> None:
        """Send what it does until it is gone or told to stop."""
        options = self._options
        state = JoyState(options.deadzone, options.sticky_buttons)
        # When the state is sent without an event; None for never.
        due_s: float | None = None
        sent_s = time.monotonic()
        while not stop.is_set():
            wait_s = _LOOK_S if due_s is None else min(_LOOK_S, max(0.0, due_s - time.monotonic()))
            ready, _, _ = select.select([descriptor], [], [], wait_s)
            now_s = time.monotonic()
            sends = due_s is not None and now_s >= due_s
            if ready:
                data = _read(descriptor)
                if data is None:
                    return
                at_once = self._take(state, data)
                sends = sends or at_once is True
                if at_once is False:
                    soon_s = now_s + options.coalesce_s
                    due_s = soon_s if due_s is None else min(due_s, soon_s)
            if sends:
                self._send(state)
                sent_s, due_s = now_s, None
            if due_s is None and options.repeat_s and (state.axes or state.buttons):
                due_s = sent_s + options.repeat_s

    def _take(self, state: JoyState, data: bytes) -> bool | None:
        """Take an event; True when it is sent at once, False when soon, None when it is unknown."""
        event = read_event(data)
        if event.is_axis and event.is_initial and not self._options.takes_initial:
            event = event._replace(value=0)
        if not state.take(event):
            self._node.log("warn", f"joy_node: Unknown event type of number {event.number}.")
            return None
        return event.is_button and not event.is_initial

    def _send(self, state: JoyState) -> None:
        message = self._message(axes=list(state.axes), buttons=list(state.buttons))
        set_header(message, self._node.clock.now_ns(), self._options.frame_id)
        self._out.publish(message)


def _read(descriptor: int) -> bytes | None:
    """Return one event, None when the device is gone."""
    try:
        data = os.read(descriptor, EVENT_BYTES)
    except OSError:
        return None
    return data if len(data) == EVENT_BYTES else None
