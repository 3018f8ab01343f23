#!/usr/bin/env python3
"""Runs the tests on every Python that is promised and found here, each in a fresh environment.

    python .ci/every_python.py [--quick] [--lowest] [--others] [PYTHON ...] [-- PYTEST ARGUMENTS]

PYTHON is a version (3.12) or a program; without one, all that the classifiers of pyproject.toml
promise are looked for: on PATH, among pyenv's versions and among uv's. Each gets the newest
packages and has its types checked; the lowest one also gets the lowest packages that pyproject.toml
allows, as its lower bounds say. The last lines are a table; the exit code is 1 where a run failed.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["candidates", "lowest_pins", "promised", "runs_of"]

_ROOT = Path(__file__).resolve().parents[1]
_ASK = "import sys; print('%d.%d.%d' % sys.version_info[:3]); print(sys.executable)"
_CLASSIFIER = "Programming Language :: Python :: "

Version = tuple[int, ...]


class Run(NamedTuple):
    """The suite on one interpreter.

    Attributes:
        version: of the interpreter.
        program: the interpreter.
        lowest: with the lowest packages allowed in place of the newest.
    """

    version: Version
    program: str
    lowest: bool


class Outcome(NamedTuple):
    """A row of the table: a run, whether it went well, the summary's words, seconds."""

    run: Run
    ok: bool
    words: str
    took_s: float


def main(arguments: list[str] | None = None) -> int:
    """Check types, run the tests and print the table."""
    options, pytest_arguments = _options(sys.argv[1:] if arguments is None else arguments)
    project = tomllib.loads((_ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = promised(project)
    found = _interpreters(options.pythons or candidates(wanted))
    # What is asked for by name need not be promised yet.
    kept = {v: p for v, p in found.items() if options.pythons or v[:2] in wanted}
    runs = runs_of(kept, lowest=options.lowest, others=options.others)
    outcomes = [_outcome(run, project, pytest_arguments, quick=options.quick) for run in runs]
    missing = [] if options.pythons else sorted(wanted - {version[:2] for version in kept})
    print("\n".join(_table(outcomes, missing)))
    return int(not all(outcome.ok for outcome in outcomes) or bool(options.pythons and not runs))


def promised(project: dict[str, Any]) -> set[Version]:
    """Return the versions that the classifiers name."""
    names = (one.removeprefix(_CLASSIFIER) for one in project["classifiers"])
    return {_version(name) for name in names if re.fullmatch(r"\d+\.\d+", name)}


def candidates(wanted: Iterable[Version]) -> Iterator[str]:
    """Yield the programs that may be a Python, not all of which need to run."""
    pyenv = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
    data = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")
    uv = Path(os.environ.get("UV_PYTHON_INSTALL_DIR") or data / "uv" / "python")
    for version in sorted(wanted):
        name = f"python{version[0]}.{version[1]}"
        if on_path := shutil.which(name):
            yield on_path
        for folder in (pyenv, uv):
            yield from map(str, sorted(folder.glob(f"*/bin/{name}")))


def runs_of(found: dict[Version, str], *, lowest: bool, others: bool) -> list[Run]:
    """Return what is to be run.

    Args:
        found: interpreters; the newest one of each minor version counts.
        lowest: only the lowest packages.
        others: only interpreters other than this one, with the newest packages.
    """
    best = {version[:2]: version for version in sorted(found)}
    if others:
        best.pop(sys.version_info[:2], None)
    versions = sorted(best.values())
    newest = [] if lowest else [Run(version, found[version], False) for version in versions]
    low = [] if others else [Run(version, found[version], True) for version in versions[:1]]
    return newest + low


_AT_LEAST = re.compile(r"\s*([\w.-]+)(?:\[[\w,-]+\])?\s*>=\s*([\w.]+)(?:\s*,.*)?\s*")


def lowest_pins(project: dict[str, Any]) -> list[str]:
    """Return the lower bounds of all requirements, as pins for pip's ``--constraint``."""
    pins = set()
    for group in (project["dependencies"], *project["optional-dependencies"].values()):
        for requirement in group:
            words, _, marker = requirement.partition(";")
            if bound := re.fullmatch(
                r"\s*([\w.-]+)(?:\[[\w,-]+\])?\s*>=\s*([\w.]+)(?:\s*,.*)?\s*", words
            ):
                pins.add(f"{bound[1]}=={bound[2]}" + (f"; {marker.strip()}" if marker else ""))
    return sorted(pins)


def _options(arguments: list[str]) -> tuple[argparse.Namespace, list[str]]:
    end = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("pythons", nargs="*", metavar="PYTHON")
    parser.add_argument("--quick", action="store_true", help="only the tests marked quick")
    parser.add_argument("--lowest", action="store_true", help="only the lowest packages allowed")
    parser.add_argument("--others", action="store_true", help="all Pythons but the one that runs")
    return parser.parse_args(arguments[:end]), arguments[end + 1 :]


def _interpreters(programs: Iterable[str]) -> dict[Version, str]:
    """Ask programs for their versions; what does not run, as pyenv's stand-ins may, is left out."""
    found: dict[Version, str] = {}
    for program in programs:
        named = f"python{program}" if re.fullmatch(r"\d+\.\d+", program) else program
        for each in candidates([_version(program)]) if named != program else [program]:
            try:
                answer = subprocess.run(
                    [each, "-c", _ASK], check=False, capture_output=True, text=True
                )
            except OSError:
                continue
            if answer.returncode == 0:
                version, executable = answer.stdout.splitlines()
                found.setdefault(_version(version), executable)
    return found


def _outcome(
    run: Run,
    project: dict[str, Any],
    pytest_arguments: list[str],
    *,
    quick: bool,
) -> Outcome:
    begin = time.monotonic()
    print(f"\n== Python {_text(run.version)}, {_packages(run)} packages ==", flush=True)
    with tempfile.TemporaryDirectory(prefix="every-python-") as folder:
        venv = Path(folder) / "venv"
        subprocess.run([run.program, "-m", "venv", str(venv)], check=True)
        constraints = venv / "constraints.txt"
        constraints.write_text("\n".join(lowest_pins(project) if run.lowest else []) + "\n")
        pip = [str(venv / "bin" / "pip"), "install", "--quiet", "--disable-pip-version-check"]
        installed = subprocess.run(
            [*pip, "-c", str(constraints), "-e", ".[dev]"], cwd=_ROOT, check=False
        )
        if installed.returncode:
            return Outcome(run, False, "pip cannot install it", time.monotonic() - begin)
        python = [str(venv / "bin" / "python"), "-m"]
        # Packages' types are other ones on every Python; old ones of the lowest need not fit.
        if not run.lowest:
            code, last = _followed([*python, "mypy", "-n", "2"], venv)
            if code:
                return Outcome(run, False, last, time.monotonic() - begin)
        tests = [*python, "pytest", "-o", f"cache_dir={folder}/pytest"]
        command = [*tests, "-n", "auto", *(["-m", "quick"] if quick else [])]
        code, last = _followed([*command, *pytest_arguments], venv)
    return Outcome(run, code == 0, last, time.monotonic() - begin)


def _followed(command: list[str], venv: Path) -> tuple[int, str]:
    """Run a command in an environment, show what it says, and return its last line."""
    path = f"{venv / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}"
    environ = {**os.environ, "VIRTUAL_ENV": str(venv), "PATH": path}
    last = ""
    with subprocess.Popen(
        command, cwd=_ROOT, env=environ, text=True, stdout=subprocess.PIPE, errors="replace"
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            print(line, end="", flush=True)
            last = line.strip(" =\n") or last
    return process.returncode, last


def _table(outcomes: list[Outcome], missing: list[Version]) -> Iterator[str]:
    yield ""
    for run, ok, words, took_s in outcomes:
        state = "ok    " if ok else "FAILED"
        yield f"{_text(run.version):<8} {_packages(run):<7} {state} {took_s:5.0f} s  {words}"
    for version in missing:
        yield f"{_text(version):<8} is not here"


def _packages(run: Run) -> str:
    return "lowest" if run.lowest else "newest"


def _version(text: str) -> Version:
    return tuple(map(int, text.split(".")))


def _text(version: Version) -> str:
    return ".".join(map(str, version))


if __name__ == "__main__":
    sys.exit(main())
