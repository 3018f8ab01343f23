"""Running a command for what it prints, which may go on for ever."""

from __future__ import annotations

import shlex
import subprocess
import threading
from collections.abc import Mapping, Sequence
from typing import IO, NamedTuple

from gazelle.documents.files import HOW_TO_RAISE, TEXT_BYTES, LimitError, scaled

__all__ = ["CommandResult", "run_limited"]

_PIECE = 1 << 16
_SHOWN = 80
_MEBIBYTE = 1 << 20


class CommandResult(NamedTuple):
    """What became of a command.

    Attributes:
        argv: program and arguments.
        returncode: its exit code, negative for a signal.
        stdout, stderr: what it printed; what is no UTF-8 is replaced.
    """

    argv: tuple[str, ...]
    returncode: int
    stdout: str
    stderr: str


def run_limited(
    argv: Sequence[str],
    *,
    env: Mapping[str, str] | None = None,
    joined: bool = False,
) -> CommandResult:
    """Run a command to its end.

    Args:
        argv: program and arguments.
        env: its environment, this process' when None.
        joined: what it says on standard error is among what it says on standard output.

    Raises:
        LimitError: it printed more than a text may be long (64 MiB), and was ended.
        OSError: it cannot be started.
    """
    most = scaled(TEXT_BYTES)
    errors = subprocess.STDOUT if joined else subprocess.PIPE
    with subprocess.Popen(argv, stdout=subprocess.PIPE, stderr=errors, env=env) as process:
        kept: dict[str, bytes] = {}
        too_much = threading.Event()

        def read(name: str, stream: IO[bytes]) -> None:
            parts, count = [], 0
            while part := stream.read1(_PIECE):  # type: ignore[attr-defined]
                count += len(part)
                if count > most:
                    too_much.set()
                    process.kill()
                    return
                parts.append(part)
            kept[name] = b"".join(parts)

        streams = {"out": process.stdout, "err": process.stderr}
        readers = [
            threading.Thread(target=read, args=(name, stream), daemon=True)
            for name, stream in streams.items()
            if stream is not None
        ]
        try:
            for one in readers:
                one.start()
            for one in readers:
                one.join()
        except BaseException:
            process.kill()
            raise
    if too_much.is_set():
        shown = shlex.join(argv)
        shown = shown if len(shown) <= _SHOWN else f"{shown[:_SHOWN]}…"
        text = f"'{shown}' prints more than {most / _MEBIBYTE:g} MiB and was ended"
        raise LimitError(f"{text} ({HOW_TO_RAISE})")
    texts = (kept.get(name, b"").decode("utf-8", "replace") for name in ("out", "err"))
    return CommandResult(tuple(argv), process.returncode, *texts)
