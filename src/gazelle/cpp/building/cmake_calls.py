"""What our CMake files ask Python for: ``python -m gazelle.cpp.building.cmake_calls …``."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import GazelleError

__all__ = ["main"]


def main(arguments: Sequence[str]) -> int:
    """Run one call; returns its exit code."""
    what, settings, *words = arguments
    memory = json.loads(Path(settings).with_suffix(".json").read_text(encoding="utf-8"))
    try:
        return _CALLS[what](Path(settings), memory, words)
    except GazelleError as error:
        sys.stderr.write(f"{error}\n")
        return 1


def _messages(settings: Path, memory: dict[str, Any], words: Sequence[str]) -> int:
    from gazelle.cpp.interfaces import package_messages

    folder, *files = words
    others = [Path(path) for path in memory["sources"]]
    package_messages(
        Path(memory["path"]), memory["generation"], Path(folder), [Path(f) for f in files], others
    )
    return 0


def _config(settings: Path, memory: dict[str, Any], words: Sequence[str]) -> int:
    from gazelle.cpp.interfaces import config_header

    folder, file = words
    config_header(Path(file), memory["package"], Path(folder))
    return 0


def _parameters(settings: Path, memory: dict[str, Any], words: Sequence[str]) -> int:
    from gazelle.cpp.interfaces import parameter_header

    folder, file, target, *validators = words
    parameter_header(Path(file), target, Path(folder), memory["package"], "".join(validators))
    return 0


def _libraries(settings: Path, memory: dict[str, Any], words: Sequence[str]) -> int:
    from gazelle.cpp.building.runtime import ensure_runtime
    from gazelle.cpp.building.settings import library_rows, quoted, write_if_changed

    runtime = ensure_runtime([*memory["libraries"], *words], memory["generation"])
    memory["libraries"] = sorted({*memory["libraries"], *words})
    write_if_changed(settings.with_suffix(".json"), json.dumps(memory, indent=1))
    text = settings.read_text(encoding="utf-8")
    for name, value in library_rows(runtime).items():
        line = f"set({name} {quoted(value)})\n"
        if line not in text:
            text += line
    write_if_changed(settings, text)
    return 0


_INCLUDE = re.compile(rb"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"]", re.MULTILINE)


def _refused_header(settings: Path, memory: dict[str, Any], words: Sequence[str]) -> int:
    """Print the refused package whose headers sources, or headers of their package, include."""
    from gazelle.cpp.requirements import refused_header

    _, top, *sources = words
    seen: set[Path] = set()
    refused: list[str] = []
    waiting = [Path(source) for source in sources]
    while waiting:
        file = waiting.pop()
        if file in seen or not file.is_file():
            continue
        seen.add(file)
        for found in _INCLUDE.findall(file.read_bytes()):
            header = found.decode(errors="replace")
            if name := refused_header(header, memory["generation"]):
                refused.append(name)
            waiting += [file.parent / header, Path(top) / "include" / header]
    if refused:
        # Gazebo's plug-ins include headers of its libraries before its own.
        sys.stdout.write(f"{max(refused, key=lambda name: name.startswith('gazebo'))}\n")
    return 0


_CALLS: dict[str, Callable[[Path, dict[str, Any], Sequence[str]], int]] = {
    "config": _config,
    "libraries": _libraries,
    "messages": _messages,
    "parameters": _parameters,
    "refused-header": _refused_header,
}


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
