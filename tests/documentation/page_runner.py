"""Runs the blocks of a page as a reader would: from top to bottom, in a fresh folder."""

from __future__ import annotations

import contextlib
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import psutil
from tests.documentation.blocks import Block, blocks_of

__all__ = ["BlockFailure", "Took", "run_page"]

ROOT = Path(__file__).parents[2]
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
_LOOK_S = 0.02
_SILENT_S = 5.0
_STATE = """
__status=$?
export -p > "$PAGE_STATE/exports"
pwd > "$PAGE_STATE/folder"
exit $__status
"""
# A line that fails is told even when others follow it.
_TRAP = """trap 'echo "exit code $?: $BASH_COMMAND" >> "$PAGE_STATE/failed"' ERR\n"""


class BlockFailure(AssertionError):
    """A block does not do what its page says; with its place, what happened, and its output."""


class Took(NamedTuple):
    """A block that was run, and the seconds of wall time it took."""

    block: Block
    wall_s: float


def _hear_ctrl_c() -> None:
    """As in a terminal: what is started in the background of a script would not hear it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class _Terminal:
    """A command that runs on, and what it has printed."""

    def __init__(self, text: str, process: subprocess.Popen[str]) -> None:
        self.text = text
        self.process = process
        self._printed: list[str] = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def output(self) -> str:
        return "".join(self._printed)

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._printed.append(line)

    def interrupt(self, patience_s: float) -> str | None:
        """Press Ctrl-C; return what is wrong with its end."""
        children = psutil.Process(self.process.pid).children(recursive=True) if self.runs else []
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGINT)
        try:
            code = self.process.wait(patience_s)
        except subprocess.TimeoutExpired:
            self.kill()
            return f"'{self.text}' does not end on Ctrl-C\n{self.output[-3000:]}"
        _, left = psutil.wait_procs(children, timeout=patience_s)
        self.kill()
        if left:
            return f"'{self.text}' leaves {len(left)} processes behind"
        if code not in (0, 1, 130, -signal.SIGINT):
            return f"'{self.text}' ends with exit code {code} on Ctrl-C\n{self.output[-3000:]}"
        return None

    @property
    def runs(self) -> bool:
        return self.process.poll() is None

    def kill(self) -> None:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


def run_page(
    page: Path, folder: Path, *, port: int, packages: Path | None = None, patience_s: float = 120.0
) -> list[Took]:
    """Run all blocks of a page that are to be run.

    Args:
        page: the file.
        folder: an empty folder, which is the reader's home, too.
        port: of the page's graph.
        packages: the folder with the workspaces of the documents and TurtleBot3's.
        patience_s: how long a block may take.

    Raises:
        BlockFailure: one of them does something else than the page says.
    """
    with _Session(page, folder, port, packages, patience_s).open() as session:
        for block in blocks_of(page):
            session.see(block)
        return session.took


class _Session:
    def __init__(
        self, page: Path, folder: Path, port: int, packages: Path | None, patience_s: float
    ) -> None:
        self.took: list[Took] = []
        self._page = page
        self._folder = folder
        self._patience_s = patience_s
        self._terminals: list[_Terminal] = []
        self._script = ""
        self._printed: Callable[[], str] = str
        self._state = Path(tempfile.mkdtemp(prefix="page-"))
        (self._state / "folder").write_text(f"{folder}\n", encoding="utf-8")
        (self._state / "exports").write_text("", encoding="utf-8")
        self._environ = _environment(self._state, folder, port, packages)

    @contextlib.contextmanager
    def open(self) -> Iterator[_Session]:
        try:
            yield self
            wrong = [one.interrupt(self._patience_s) for one in reversed(self._terminals)]
            self._terminals = []
            if told := [text for text in wrong if text]:
                raise BlockFailure(f"{self._page.name}: " + "\n".join(told))
        finally:
            for terminal in self._terminals:
                terminal.kill()
            shutil.rmtree(self._state, ignore_errors=True)

    def see(self, block: Block) -> None:
        started = time.monotonic()
        for name in block.marks.get("stop", "").splitlines():
            self._stop(block, name)
        if before := block.marks.get("before"):
            self._shell(block, before)
        for line in block.marks.get("running", "").splitlines():
            command, _, text = line.partition(" => ")
            self._await(block, self._open(command), text)
        if name := block.marks.get("file"):
            path = Path(self._cwd(), name).expanduser()
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, encoding="utf-8")
            if block.text.startswith("#!"):
                path.chmod(0o755)
        elif block.is_output:
            self._compare(block)
        elif block.is_run and block.language == "python":
            self._script = (self._script if "continues" in block.marks else "") + block.text
            enter = self._begin() + 'exec "$@"'
            words = ["bash", "-c", enter, "bash", sys.executable, "-c", self._script]
            self._finished(block, words)
        elif block.is_run:
            self._type(block)
        if block.is_run:
            self.took.append(Took(block, time.monotonic() - started))

    def _type(self, block: Block) -> None:
        """Type a shell block; its last commands may run on."""
        texts = [text.strip() for text in block.marks.get("runs on", "").split("|") if text.strip()]
        commands = _commands(block.text)
        if texts:
            typed, kept = commands[: -len(texts)], commands[-len(texts) :]
        else:
            typed, kept = commands, []
        until_stopped = [one for one in typed if "Ctrl-C" in one]
        if until_stopped and not kept:
            self._type_until_stopped(block, typed)
        elif typed:
            self._shell(block, "\n".join(typed), block.marks.get("exit"))
        for command, text in zip(kept, texts, strict=True):
            terminal = self._open(command)
            self._await(block, terminal, text)

    def _type_until_stopped(self, block: Block, commands: list[str]) -> None:
        """Type line by line; those that the page says to end by Ctrl-C are ended so."""
        for command in commands:
            if "Ctrl-C" not in command:
                self._shell(block, command)
                continue
            terminal = self._open(command)
            self._await(block, terminal, "-")
            self._terminals.remove(terminal)
            if wrong := terminal.interrupt(self._patience_s):
                raise BlockFailure(f"{block}: {wrong}")
            self._printed = lambda terminal=terminal: terminal.output  # type: ignore[misc]

    def _open(self, command: str) -> _Terminal:
        process = subprocess.Popen(
            ["bash", "-c", self._begin() + "exec " * _is_plain(command) + command],
            cwd=self._cwd(),
            env=self._environ,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
            preexec_fn=_hear_ctrl_c,  # noqa: PLW1509 - it takes no lock
        )
        terminal = _Terminal(command, process)
        self._terminals.append(terminal)
        self._printed = lambda: terminal.output
        return terminal

    def _await(self, block: Block, terminal: _Terminal, text: str) -> None:
        begun = time.monotonic()
        end = begun + self._patience_s
        pattern = re.compile("." if text == "-" else _loose(text), re.DOTALL)
        while not pattern.search(_even(terminal.output)):
            if text == "-" and terminal.runs and time.monotonic() > begun + _SILENT_S:
                return
            if not terminal.runs or time.monotonic() > end:
                state = "still runs" if terminal.runs else f"ended ({terminal.process.poll()})"
                raise BlockFailure(
                    f"{block}: '{terminal.text}' {state} and has not printed '{text}'\n"
                    f"{terminal.output[-4000:]}"
                )
            time.sleep(_LOOK_S)

    def _stop(self, block: Block, name: str) -> None:
        found = [one for one in self._terminals if name in one.text]
        if not found:
            raise BlockFailure(f"{block}: nothing that runs is '{name}'")
        self._terminals.remove(found[-1])
        if wrong := found[-1].interrupt(self._patience_s):
            raise BlockFailure(f"{block}: {wrong}")

    def _shell(self, block: Block, text: str, exit_code: str | None = None) -> None:
        script = self._begin() + _TRAP * (exit_code is None) + text + _STATE
        self._finished(block, ["bash", "-c", script], int(exit_code or 0))
        failed = self._state / "failed"
        if failed.exists():
            told = failed.read_text(encoding="utf-8")
            failed.unlink()
            raise BlockFailure(f"{block}: {told}{self._printed()[-4000:]}")

    def _finished(self, block: Block, words: list[str], exit_code: int = 0) -> None:
        with subprocess.Popen(
            words,
            cwd=self._cwd(),
            env=self._environ,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        ) as process:
            try:
                output, _ = process.communicate(timeout=self._patience_s)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                output, _ = process.communicate()
                raise BlockFailure(f"{block}: does not end\n{output[-4000:]}") from None
        self._printed = lambda: output
        if process.returncode != exit_code:
            failed = self._state / "failed"
            told = failed.read_text(encoding="utf-8") if failed.exists() else ""
            raise BlockFailure(f"{block}: exit code {process.returncode}\n{told}{output[-4000:]}")

    def _begin(self) -> str:
        return f'. "$PAGE_STATE/exports"\ncd {shlex.quote(self._cwd())}\n'

    def _cwd(self) -> str:
        return (self._state / "folder").read_text(encoding="utf-8").strip()

    def _compare(self, block: Block) -> None:
        """Look for the lines of a text block, in this order, in what was printed."""
        lines = [line.strip() for line in block.text.splitlines() if line.strip(" …")]
        any_number = "varies" in block.marks
        patterns = [_loose(line, any_number=any_number) for line in lines]
        wanted = re.compile(r"[^\n]*\n(?:.*\n)*?[^\n]*".join(patterns))
        end = time.monotonic() + (self._patience_s if self._is_running() else 0.0)
        while not wanted.search(_even(self._printed())):
            if time.monotonic() > end:
                raise BlockFailure(
                    f"{block}: this is not what is printed:\n{self._printed()[-4000:]}"
                )
            time.sleep(_LOOK_S)

    def _is_running(self) -> bool:
        return any(terminal.runs for terminal in self._terminals)


def _commands(text: str) -> list[str]:
    """Return the commands of a shell block: its lines, those that go on joined."""
    joined = re.sub(r"\\\n\s*", " ", text)
    return [line for line in joined.splitlines() if line.strip() and not line.startswith("#")]


def _is_plain(command: str) -> bool:
    """Return whether a line is one program and its arguments, which the shell may become."""
    return re.match(r"[\w./~-]+(?: |$)", command) is not None and not re.search(r"[;&|]", command)


def _loose(text: str, *, any_number: bool = False) -> str:
    """Return a pattern: ``…`` is anything in a line, blanks are as many as there are."""
    pieces = []
    for piece in re.split(r"(…)", _even(text)):
        if piece == "…":
            pieces.append(r"[^\n]*?")
            continue
        parts = _NUMBER.split(piece) if any_number else [piece]
        pieces.append(_NUMBER.pattern.join(map(re.escape, parts)))
    return "".join(pieces)


def _even(text: str) -> str:
    return re.sub(r"[ \t]+", " ", re.sub(r"\x1b\[[0-9;]*m", "", text))


def _environment(state: Path, folder: Path, port: int, packages: Path | None) -> dict[str, str]:
    """What a fresh terminal has, and ``gazelle`` on its PATH."""
    programs = state / "bin"
    programs.mkdir()
    python = shlex.quote(sys.executable)
    words = {"gazelle": f"{python} -m gazelle.cli", "pytest": f"{python} -m pytest"}
    for name, command in (words | dict.fromkeys(("python", "python3"), python)).items():
        (programs / name).write_text(f'#!/bin/sh\nexec {command} "$@"\n', encoding="utf-8")
        (programs / name).chmod(0o755)
    kept = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
    kept |= {
        "CLONE": str(ROOT),
        "GAZELLE_PORT": str(port),
        "HOME": str(folder),
        "PACKAGES": str(packages or ""),
        "PAGE_STATE": str(state),
        "PATH": f"{programs}:{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT / "src"),
        "PYTHONUNBUFFERED": "1",
    }
    # Compiled kernels are kept from page to page; nothing else of the home is.
    kept.setdefault("XDG_CACHE_HOME", str(Path.home() / ".cache"))
    kept.pop("PYTEST_ADDOPTS", None)
    return kept
