"""The words of CMake, compiler and linker, passed on as they are, and one line of ours to each."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from gazelle.cpp.building.cmake import CMakeRun
from gazelle.cpp.building.settings import Unit
from gazelle.cpp.requirements import header_advice, library_advice, package_advice
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["report_failures"]

_PLACE = re.compile(
    r"^(?P<file>[^\s:][^:\n]*):(?P<line>\d+):(?:(?P<column>\d+):)? (?:fatal )?error: (?P<text>.*)$",
    re.M,
)
_HEADER = re.compile(r"fatal error: '?([^\s':]+)'?(?:: No such file or directory| file not found)")
_PACKAGE = re.compile(
    r"provided by\s+\"([^\"]+)\"|Could NOT find (\w+)|By not providing \"Find(\w+)\.cmake\""
)
_CMAKE_PLACE = re.compile(r"CMake Error at ([^:\n]+):(\d+)")
_LINKER = re.compile(r"undefined reference to [`'\"](.+?)['\"]|undefined symbol: (\S.*)")
_EXCERPT = re.compile(r"^\s*(\d+\s)?\s*\|")
_NO_ROOM = re.compile(r"No space left on device|Disk quota exceeded")


def report_failures(unit: Unit, run: CMakeRun, diagnostics: Diagnostics) -> None:
    """Report what a step said of what went wrong.

    Args:
        unit: the package.
        run: the step.
        diagnostics: receives a finding for each thing that failed.
    """
    everything = "\n".join(run.lines)
    if _NO_ROOM.search(everything):
        text = f"compiling '{unit.name}' in '{unit.build}': no space left on device"
        diagnostics.report("cpp.no-room", text)
        return
    if not run.failures:
        _report_cmake(unit, everything, diagnostics)
        return
    for made, words in run.failures.items():
        _report_one(unit, made, words, diagnostics)


def _report_cmake(unit: Unit, words: str, diagnostics: Diagnostics) -> None:
    place = _CMAKE_PLACE.search(words)
    span = SourceSpan(str(unit.path / "CMakeLists.txt"))
    if place is not None:
        file = Path(place[1])
        # A path is relative to the sources; one of ours is not the user's.
        full = file if file.is_absolute() else unit.path / file
        if full.is_relative_to(unit.path):
            span = SourceSpan(str(full), int(place[2]))
        elif calls := re.search(r"^\s+(CMakeLists\.txt):(\d+) \(", words, re.M):
            span = SourceSpan(str(unit.path / calls[1]), int(calls[2]))
    for found in _PACKAGE.finditer(words):
        name = next(filter(None, found.groups()))
        text, fix = package_advice(name, unit.generation)
        diagnostics.report("cpp.missing-package", f"{unit.name}: {text}", span, fix=fix)
        return
    start = words.find("CMake Error")
    quoted = words[start:].strip() if start >= 0 else words.strip()[-2000:]
    diagnostics.report("cpp.configure-error", f"CMake of '{unit.name}' failed:\n{quoted}", span)


def _report_one(unit: Unit, made: str, words: str, diagnostics: Diagnostics) -> None:
    place = _PLACE.search(words)
    span = None
    if place is not None:
        file = Path(place["file"])
        full = file if file.is_absolute() else (unit.build / file).resolve()
        span = SourceSpan(str(full), int(place["line"]), int(place["column"] or 0))
    if header := _HEADER.search(words):
        text, fix = header_advice(header[1], unit.generation)
        words = _after_place(words, place).replace("\ncompilation terminated.", "")
        diagnostics.report("cpp.missing-header", f"{words}\n{text}", span, fix=fix)
        return
    name = (
        made.split(".dir/", maxsplit=1)[0].rsplit("/", 1)[-1]
        if ".dir/" in made
        else Path(made).name
    )
    missing = list(dict.fromkeys(_undefined(words)))
    if missing and span is None:
        text = f"'{name}' does not link:\n{_trimmed(words)}"
        advice, fix = library_advice(missing)
        text = f"{text}\n{advice}" if advice else text
        span = SourceSpan(str(unit.path / "CMakeLists.txt"))
        diagnostics.report("cpp.link-error", text, span, fix=fix)
        return
    head, _, rest = _after_place(words, place).partition("\n")
    text = f"{head} ('{name}' of '{unit.name}' does not compile)\n{rest}".rstrip()
    diagnostics.report("cpp.compile-error", text, span)


def _after_place(words: str, place: re.Match[str] | None) -> str:
    """Return a compiler's words with the first error in front, for its place is shown anyway."""
    if place is None:
        return _trimmed(words)
    before, after = words[: place.start()], words[place.end() :].lstrip("\n").split("\n")
    while after and _EXCERPT.match(after[0]):
        after.pop(0)
    context = [line for line in before.splitlines() if " from " in line or "required" in line]
    return _trimmed("\n".join([place["text"], *context, *after]))


def _undefined(words: str) -> Iterator[str]:
    for found in _LINKER.finditer(words):
        yield found[1] or found[2]


_LONGEST = 60


def _trimmed(words: str) -> str:
    lines = words.strip().splitlines()
    if len(lines) > _LONGEST:
        lines = [*lines[:_LONGEST], f"… and {len(lines) - _LONGEST} lines more"]
    return "\n".join(lines)
