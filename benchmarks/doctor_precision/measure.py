"""How exactly the doctor tells of mistakes: mutants of robot packages, each looked at once.

Run ``python benchmarks/doctor_precision/measure.py [--count 1000] [--kind PREFIX]
[--workspaces DIR] [--out FILE]`` from the repository. Every mutant is one of `mistakes.MISTAKES`
made at one place of one package: those of ``examples/``, those that ``gazelle new`` writes, and the
packages in the workspaces of another folder. Told is what the doctor did not say of it before.

A mutant counts as told with one finding more than before (a notice where there is nothing worse),
and as placed when the worst of them, the first of these, names the line that was written wrongly.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import random
import re
import shutil
import statistics
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from mistakes import MISTAKES, Mutant

from gazelle.diagnostics import Diagnostic, Severity
from gazelle.doctor.fixes import SourceText, mend

_REPOSITORY = Path(__file__).parents[2]
_NUMBER = re.compile(r"\d+")
_TEXTS = {
    ".xacro", ".urdf", ".xml", ".launch", ".world", ".sdf", ".yaml", ".srdf", ".py", ".txt",
}  # fmt: skip
_place = Path()


class Case(NamedTuple):
    """A mutant of one package of one workspace."""

    base: str
    package: str
    mutant: Mutant


def main() -> None:
    """Measure, print the kinds, and the mutants that fell short."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="of mutants")
    parser.add_argument("--seed", type=int, default=7, help="of the choice of places")
    parser.add_argument("--kind", default="", help="only kinds whose name begins so")
    parser.add_argument("--workspaces", type=Path, help="a folder of more workspaces")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=Path, help="a line of JSON for each mutant")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        _lay_out(place / "bases", options.workspaces)
        cases = _chosen(list(_cases(place / "bases")), options.count, options.kind, options.seed)
        packages = sorted({(case.base, case.package) for case in cases})
        with multiprocessing.get_context("spawn").Pool(
            options.jobs, _begin, (place / "bases",), maxtasksperchild=60
        ) as pool:
            before = dict(zip(packages, pool.map(_examined, packages, 1), strict=True))
            jobs = [(case, before[case.base, case.package]) for case in cases]
            results = []
            for number, result in enumerate(pool.imap_unordered(_tried, jobs, 4), 1):
                results.append(result)
                print(f"\r{number} of {len(jobs)}", end="", file=sys.stderr, flush=True)
    results.sort(key=lambda item: (item["kind"], item["base"], item["file"], item["lines"]))
    if options.out:
        options.out.write_text("".join(json.dumps(item) + "\n" for item in results), "utf-8")
    _print_kinds(results)


def _lay_out(place: Path, workspaces: Path | None) -> None:
    """Put every workspace side by side."""
    from gazelle.workspace.scaffold import create_package

    for folder in sorted((_REPOSITORY / "examples").glob("*_ws")):
        shutil.copytree(folder, place / folder.name)
    for number in (1, 2):
        source = place / f"new{number}_ws" / "src"
        source.mkdir(parents=True)
        create_package("robot", f"rover{number}", source, ros_version=number)  # type: ignore[arg-type]
    for folder in sorted(workspaces.iterdir()) if workspaces else ():
        if (folder / "src").is_dir():
            shutil.copytree(folder, place / folder.name, symlinks=True)


def _cases(bases: Path) -> Iterator[Case]:
    for manifest in sorted(bases.rglob("package.xml")):
        package = manifest.parent
        base = bases / package.relative_to(bases).parts[0]
        for path in sorted(package.rglob("*")):
            if path.suffix not in _TEXTS or path.is_symlink() or not path.is_file():
                continue
            text = path.read_text("utf-8")
            for mistake in MISTAKES:
                for mutant in mistake.mutants(path.relative_to(base), text):
                    yield Case(base.name, package.name, mutant)


def _chosen(cases: Sequence[Case], count: int, kind: str, seed: int) -> list[Case]:
    """Take of each kind in turn, in a shuffled order that is the same each time."""
    by_kind: dict[str, list[Case]] = defaultdict(list)
    for case in cases:
        if case.mutant.mistake.startswith(kind):
            by_kind[case.mutant.mistake].append(case)
    for name, some in by_kind.items():
        random.Random(f"{seed}{name}").shuffle(some)
    chosen: list[Case] = []
    while len(chosen) < count and any(by_kind.values()):
        for some in by_kind.values():
            if some and len(chosen) < count:
                chosen.append(some.pop())
    return chosen


def _begin(bases: Path) -> None:
    """Give a worker workspaces of its own."""
    global _place
    _place = Path(tempfile.mkdtemp(dir=bases.parent))
    shutil.copytree(bases, _place, dirs_exist_ok=True, symlinks=True)


def _examined(target: tuple[str, str]) -> list[dict[str, Any]]:
    """Return what the doctor says of a package."""
    return [_named(item, _place / target[0]) for item in _found(target)]


def _found(target: tuple[str, str]) -> list[Diagnostic]:
    from gazelle.doctor import Options, examine

    base, package = target
    place = _place / base
    environ = {
        **os.environ,
        "ROS_PACKAGE_PATH": str(place / "src"),
        "TURTLEBOT3_MODEL": "waffle_pi",
    }
    manifests = place.rglob("package.xml")
    folder = next(path.parent for path in manifests if path.parent.name == package)
    try:
        report = examine([f"{folder}/"], options=Options(environ=environ), cwd=place)
    except Exception as error:  # noqa: BLE001 - a crash is a result, too
        return [Diagnostic(f"CRASH {type(error).__name__}", Severity.ERROR, str(error))]
    return list(report.findings)


def _named(item: Diagnostic, place: Path) -> dict[str, Any]:
    return {
        "code": item.code,
        "severity": int(item.severity),
        "message": item.message.replace(str(place), ""),
        "file": item.span.file.replace(f"{place}/", "") if item.span else "",
        "line": item.span.line if item.span else 0,
        "fix": item.fix,
    }


class _Ward:
    """A worker's workspace as the fixes see it: the mutated package may be changed."""

    def __init__(self, case: Case) -> None:
        self._target = case.base, case.package
        self._place = _place / case.base

    def read(self, file: str) -> SourceText | None:
        """Return a file of the workspace."""
        path = Path(file)
        if not path.is_relative_to(self._place) or not path.is_file() or path.is_symlink():
            return None
        return SourceText(file, path.read_text("utf-8"))

    def write(self, file: str, text: str) -> None:
        """Change it."""
        Path(file).write_text(text, "utf-8")

    def examine(self) -> list[Diagnostic]:
        """Return what is said now."""
        return _found(self._target)


def _tried(job: tuple[Case, list[dict[str, Any]]]) -> dict[str, Any]:
    case, before = job
    place = _place / case.base
    file = place / case.mutant.file
    whole = file.read_text("utf-8")
    file.write_text(case.mutant.text, "utf-8")
    texts = {file: whole}
    try:
        found = _found((case.base, case.package))
        after = [_named(item, place) for item in found]
        new = _new(before, after)
        alarms = sorted((one for one in new if one["severity"] > 10), key=_severity_order)
        alarms = alarms or new
        mended = _mended(case, before, found, alarms, texts)
    finally:
        for path, text in texts.items():
            path.write_text(text, "utf-8")
    first = alarms[0] if alarms else None
    is_there = first is not None and first["file"] == str(case.mutant.file)
    return {
        "kind": case.mutant.mistake, "base": case.base, "file": str(case.mutant.file),
        "lines": sorted(case.mutant.lines),
        "wrote": case.mutant.text.splitlines()[min(case.mutant.lines) - 1 :][:2],
        "told": bool(alarms), "placed": is_there and first["line"] in case.mutant.lines,
        **mended,
        "findings": alarms, "notices": [one for one in new if one["severity"] <= 10],
    }  # fmt: skip


def _mended(
    case: Case,
    before: list[dict[str, Any]],
    found: list[Diagnostic],
    alarms: list[dict[str, Any]],
    texts: dict[Path, str],
) -> dict[str, Any]:
    """Apply the fixes of the new findings; nothing of them may be left, and nothing come."""
    ward, place = _Ward(case), _place / case.base
    for item in found:
        for span in (item.span, *item.span.via) if item.span else ():
            source = ward.read(span.file)
            if source is not None:
                texts.setdefault(Path(span.file), source.text)
    done = mend(ward, found, wanted=lambda item: _named(item, place) in alarms) if alarms else []
    left = [_named(item, place) for item in ward.examine()] if done else []
    left = [one for one in _new(before, left) if one["severity"] > 10]
    now = (place / case.mutant.file).read_text("utf-8")
    return {
        "mended": bool(done) and not left,
        "same": now.split() == texts[place / case.mutant.file].split(),
        "written": [edit.text for one in done for edit in one.candidate.edits],
        "left": [f"{one['code']} {one['message'][:120]}" for one in left],
    }


def _severity_order(finding: dict[str, Any]) -> int:
    return -int(finding["severity"])


def _new(before: list[dict[str, Any]], after: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return what was not said before; lines and numbers may have moved."""
    known = Counter(_kind(one) for one in before)
    new = []
    for one in after:
        if known[_kind(one)] > 0:
            known[_kind(one)] -= 1
        else:
            new.append(one)
    return new


def _kind(finding: dict[str, Any]) -> tuple[str, str, str]:
    message = _NUMBER.sub("0", finding["message"].partition("\n")[0])
    return finding["code"], finding["file"], message


def _print_kinds(results: Sequence[dict[str, Any]]) -> None:
    kinds: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for result in results:
        kinds[result["kind"]].append(result)
    print(f"{'kind':34} mutants  told  placed  mended  as was  findings")
    for name, some in [*kinds.items(), ("all", list(results))]:
        told = sum(item["told"] for item in some)
        placed = sum(item["placed"] for item in some)
        mended = sum(item["mended"] for item in some)
        same = sum(item["same"] for item in some)
        number = statistics.median(len(item["findings"]) for item in some) if some else 0
        print(f"{name:34} {len(some):7} {told:5} {placed:7} {mended:7} {same:7} {number:9g}")


if __name__ == "__main__":
    main()
