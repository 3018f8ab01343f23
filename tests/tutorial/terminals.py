"""Terminals as a person has them: bash on a pseudo-terminal, keys in, everything shown out."""

from __future__ import annotations

import codecs
import contextlib
import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import termios
import threading
from pathlib import Path

from tests.patience import PATIENCE_S, await_change, stretched

__all__ = ["Terminal"]

_PROMPT = re.compile(r"\[(\d+)\]\$ \Z")
# What a terminal acts on and does not show: colours, modes, titles, the bell.
_CONTROL = re.compile(r"\x1b\[[?\d;]*[a-zA-Z]|\x1b\][^\x07]*\x07|\x07")
_UNFINISHED = re.compile(r"(\r|\x1b\[?[?\d;]*|\x1b\][^\x07]*)\Z")
# Opening the terminal makes it the controlling one, so that Ctrl-C reaches what runs in it.
_OPEN = 'exec bash --noprofile --norc -i <>"$0" >&0 2>&0'


class Terminal:
    """One terminal with its bash; the prompt shows the last exit code.

    Attributes:
        text: everything shown so far, without colours.
    """

    def __init__(self, environ: dict[str, str], cwd: Path) -> None:
        self.text = ""
        self._mark = 0
        self._changed = threading.Condition()
        self._keys, seen = pty.openpty()
        # Each its own: many are opened at once, and one would read what another begins to write.
        inputrc = cwd / f".inputrc-{Path(os.ttyname(seen)).name}"
        inputrc.write_text("set enable-bracketed-paste off\n")
        fcntl.ioctl(seen, termios.TIOCSWINSZ, struct.pack("HHHH", 50, 400, 0, 0))
        own = {"PS1": "[$?]$ ", "INPUTRC": str(inputrc), "TERM": "xterm", "HOME": str(cwd)}
        self._bash = subprocess.Popen(
            ["sh", "-c", _OPEN, os.ttyname(seen)],
            env={**environ, **own}, cwd=cwd, start_new_session=True,
        )  # fmt: skip
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.wait_for(_PROMPT.pattern)
        # Not sooner: reading from a terminal that nobody has open fails.
        os.close(seen)

    def type(self, keys: str) -> None:
        """Press keys; what is shown from here on is what `wait_for` looks at."""
        with self._changed:
            self._mark = len(self.text)
        os.write(self._keys, keys.encode())

    def run(self, line: str, *, code: int = 0, timeout_s: float = PATIENCE_S) -> str:
        """Type a line, wait for the prompt and return what was shown in between."""
        self.type(f"{line}\r")
        return self.ended(code, timeout_s)

    def start(self, line: str, pattern: str) -> str:
        """Type a line and return what matches in its output as soon as it is there."""
        self.type(f"{line}\r")
        self.wait_for(r"\n")
        self._mark = self.text.index("\n", self._mark)
        return self.wait_for(pattern)

    def pause(self, seconds: float) -> None:
        """Do what people do between two keys."""
        threading.Event().wait(seconds)

    def interrupt(self, *, code: int | None = None) -> str:
        """Press Ctrl-C and return what is shown until the prompt."""
        self.type("\x03")
        return self.ended(code)

    def ended(self, code: int | None = 0, timeout_s: float = PATIENCE_S) -> str:
        """Wait for the prompt after the typed line and return what was shown before it."""
        self.wait_for(r"\n?" + _PROMPT.pattern, timeout_s)
        # Back to a line's beginning where it is already: bash does so now and then.
        shown = self.text[self._mark :].replace("\n\r", "\n")
        found = _PROMPT.search(shown)
        assert found is not None
        assert code is None or int(found[1]) == code, shown
        return shown[shown.find("\n") + 1 : found.start()]

    def wait_for(self, pattern: str, timeout_s: float = PATIENCE_S) -> str:
        """Return what a regular expression finds in the text since the last keys."""
        wanted = re.compile(pattern, re.MULTILINE)

        def found() -> str:
            match = wanted.search(self.text, self._mark)
            return match[0] if match else ""

        with self._changed:
            assert await_change(self._changed, found, timeout_s), (
                f"{pattern!r} is not shown:\n{self.text[self._mark :]}"
            )
            return found()

    def close(self) -> None:
        """End the shell and everything that runs in it."""
        with contextlib.suppress(ProcessLookupError, OSError):
            os.killpg(os.tcgetpgrp(self._keys), signal.SIGKILL)
        self._bash.kill()
        self._bash.wait(stretched())
        self._reader.join(stretched())
        os.close(self._keys)

    def _read(self) -> None:
        # The other end is closed: the shell has ended.
        with contextlib.suppress(OSError):
            decoder, rest = codecs.getincrementaldecoder("utf-8")("replace"), ""
            while piece := os.read(self._keys, 65536):
                raw = rest + decoder.decode(piece)
                # A piece may end between the two characters of a line's end, or within a colour.
                whole = _UNFINISHED.sub("", raw)
                rest = raw[len(whole) :]
                with self._changed:
                    self.text += _CONTROL.sub("", whole).replace("\r\n", "\n")
                    self._changed.notify_all()
