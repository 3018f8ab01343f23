"""The process that light built-in nodes share, as its launcher sees it."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.launch.launch_config import NodeTag
from gazelle.launch.node_process import node_argv
from gazelle.process_lifetime import PARENT_VARIABLE

__all__ = ["HostEnded", "NodeEnded", "NodeHost", "NodeReady"]


class NodeEnded:
    """A hosted node has ended."""

    def __init__(self, host_id: int, code: int) -> None:
        self.host_id = host_id
        self.code = code


class NodeReady:
    """A hosted node that stays has done what others may wait for."""

    def __init__(self, host_id: int) -> None:
        self.host_id = host_id


class HostEnded:
    """The host itself has ended, and every node in it."""

    def __init__(self, code: int) -> None:
        self.code = code


class NodeHost:
    """Starts and stops nodes in one child process over a pipe of JSON lines.

    Attributes:
        popen: the child.
    """

    def __init__(
        self, environment: Mapping[str, str], cwd: Path, events: queue.SimpleQueue[Any]
    ) -> None:
        read_fd, write_fd = os.pipe()
        variables = {**environment, PARENT_VARIABLE: str(os.getpid())}
        argv = [sys.executable, "-m", "gazelle.nodes", "--host", str(write_fd)]
        self.popen = subprocess.Popen(
            argv,
            env=variables,
            cwd=cwd,
            stdin=subprocess.PIPE,
            pass_fds=(write_fd,),
            start_new_session=True,
        )
        os.close(write_fd)
        self._events = events
        self._status = os.fdopen(read_fd, "r", encoding="utf-8")
        threading.Thread(target=self._read_status, daemon=True).start()

    def start(self, host_id: int, node: str, spec: NodeTag, log_file: str) -> None:
        """Start a node; its end comes back as a `NodeEnded` event."""
        start = {
            "id": host_id,
            "node": node,
            "argv": [*node_argv(spec), f"__log:={log_file}"],
            "namespace": spec.namespace.rstrip("/") or "/",
            "output": spec.output,
        }
        self._send({"start": start})

    def stop(self, host_id: int) -> None:
        """Ask a node to end."""
        self._send({"stop": host_id})

    def _send(self, command: dict[str, Any]) -> None:
        stream = self.popen.stdin
        assert stream is not None
        try:
            stream.write(json.dumps(command).encode() + b"\n")
            stream.flush()
        except BrokenPipeError:
            # Its death is on its way as an event of its own.
            return

    def _read_status(self) -> None:
        with self._status:
            for line in self._status:
                message = json.loads(line)
                if "ready" in message:
                    self._events.put(NodeReady(message["id"]))
                else:
                    self._events.put(NodeEnded(message["id"], message["exit"]))
        self._events.put(HostEnded(self.popen.wait()))
