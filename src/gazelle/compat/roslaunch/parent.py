"""Launch files from Python (roslaunch.parent)."""

from __future__ import annotations

import atexit
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.compat.roslaunch.core import Process, ProcessListener, RLException, start_launch
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.workspace import Workspace

__all__ = ["ROSLaunchParent"]

_PAUSE_S = 0.1
File = str | tuple[str, Sequence[str]]


class ROSLaunchParent:
    """Runs launch files until `shutdown`.

    Args:
        run_id: identifier of the run.
        roslaunch_files: paths, or pairs of a path and its ``name:=value`` words. Without words the
            program's own count, as in roslaunch.
        is_core: start the graph alone.
        port: of the graph.
        local_only: without effect: nodes always run on this machine.
        is_rostest: without effect: tests of a launch are run by ``rostest``.
        num_workers, timeout, master_logger_level: without effect: they are the master's, and there
            is none.
        process_listeners: hear of launches that end, by their file; not of single nodes.
        verbose: print each file as it is read.
        force_screen, force_log, force_required: as ``--screen``, ``--log``, ``--required``.
        roslaunch_strs: launch files as text.
        show_summary: print the SUMMARY block.
        sigint_timeout, sigterm_timeout: seconds that nodes have to end.
    """

    def __init__(  # noqa: PLR0913, PLR0917 - the original's signature
        self,
        run_id: str,
        roslaunch_files: Sequence[File],
        is_core: bool = False,
        port: int | None = None,
        local_only: bool = False,
        process_listeners: Sequence[ProcessListener] | None = None,
        verbose: bool = False,
        force_screen: bool = False,
        force_log: bool = False,
        is_rostest: bool = False,
        roslaunch_strs: Sequence[str] | None = None,
        num_workers: int = 3,
        timeout: float | None = None,
        master_logger_level: Any = False,
        show_summary: bool = True,
        force_required: bool = False,
        sigint_timeout: float = 15.0,
        sigterm_timeout: float = 2.0,
    ) -> None:
        self.run_id = run_id
        self._files = [_with_launch_args(one) for one in roslaunch_files or ()]
        self._texts = list(roslaunch_strs or ())
        self._is_core = is_core
        self._port = port
        self._listeners = list(process_listeners or ())
        self._patience_s = sigint_timeout + sigterm_timeout
        self._processes: list[Process] = []
        self._auto_terminate = True
        self._is_shut_down = False
        flags = {
            "--screen": force_screen,
            "--log": force_log,
            "--required": force_required,
            "-v": verbose,
            "--no-summary": not show_summary,
        }
        self._options = [name for name, is_set in flags.items() if is_set]
        self._options += ["--run_id", run_id] if run_id else []
        self._options += ["-p", str(port)] if port else []
        self._options += [f"--sigint-timeout={sigint_timeout}"]
        self._options += [f"--sigterm-timeout={sigterm_timeout}"]

    def start(self, auto_terminate: bool = True) -> None:
        """Start everything.

        Args:
            auto_terminate: `spin` ends with the last launch, and not only with `shutdown`.

        Raises:
            RLException: a file does not exist or has errors.
        """
        self._auto_terminate = auto_terminate
        for path, launch_args in self._files:
            _check(path, launch_args)
        if self._is_core:
            self._start("roscore", [*self._options, "--core"])
        for path, launch_args in self._files:
            self._start(path, [*self._options, path, *launch_args])
        for number, text in enumerate(self._texts):
            self._start(f"<string {number}>", [*self._options, "-"], text)
        atexit.register(self.shutdown)

    def spin_once(self) -> bool:
        """Tell whether something runs still, or would be waited for."""
        for one in [one for one in self._processes if not one.is_alive()]:
            self._processes.remove(one)
            for listener in self._listeners:
                listener.process_died(one.name, one.exit_code or 0)
        return bool(self._processes) or not (self._auto_terminate or self._is_shut_down)

    def spin(self) -> None:
        """Wait until everything has ended."""
        while self.spin_once():
            time.sleep(_PAUSE_S)

    def shutdown(self) -> None:
        """End everything; twice does nothing."""
        self._is_shut_down = True
        atexit.unregister(self.shutdown)
        errors: list[str] = []
        for one in self._processes:
            one.stop(errors)
        self.spin_once()
        for text in errors:
            sys.stderr.write(f"{text}\n")

    def _start(self, name: str, argv: list[str], text: str | None = None) -> None:
        made = start_launch(name, argv, text=text, patience_s=self._patience_s, port=self._port)
        self._processes.append(made)


def _with_launch_args(file: File) -> tuple[str, list[str]]:
    if isinstance(file, str | Path):
        own = [one for one in sys.argv[1:] if ":=" in one and not one.startswith(("-", "_"))]
        return str(file), own
    path, launch_args = file
    return str(path), list(launch_args)


def _check(path: str, launch_args: list[str]) -> None:
    if not Path(path).is_file():
        raise RLException(f"[{path}] does not exist: roslaunch file not found")
    diagnostics = Diagnostics()
    args = dict(one.split(":=", 1) for one in launch_args if ":=" in one)
    try:
        workspace = Workspace.discover()
        load_launch_files([Path(path)], args, workspace=workspace, diagnostics=diagnostics)
        diagnostics.raise_if_errors()
    except GazelleError as error:
        raise RLException(str(error)) from error
