"""Launch files that mean nothing alone: without arguments, environment or the file around them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostic, Diagnostics, SourceSpan
from gazelle.doctor.report import Examination
from gazelle.doctor.target import package_at
from gazelle.launch.launch_config import LaunchConfig

__all__ = ["report_required", "without_consequences"]

_UNSET = frozenset({"launch.arg-missing", "launch.arg-undeclared", "launch.env-missing"})
_QUOTED = re.compile(r"'([^'\n]+)'")


def report_required(config: LaunchConfig, found: Diagnostics, examination: Examination) -> bool:
    """Tell of a file that means nothing without arguments or environment; True when it is one."""
    file = Path(config.files[0])
    unset = found.by_code("launch.env-missing")
    if unset:
        text = f"'{file.name}' needs the environment and is not started: {unset[0].message}"
        fix = "examine it with the variable exported"
        _report(text, unset[0].span, fix, unset[0].phrase, examination)
        return True
    needed = [item for item in config.args if item.default is None and item.value is None]
    given = examination.options.arguments
    missing = [item for item in needed if item.name not in given]
    if missing:
        argv = " ".join(f"{item.name}:=…" for item in missing)
        text = f"'{file.name}' needs arguments and is not started: "
        text += ", ".join(
            f"{item.name} ({item.doc})" if item.doc else item.name for item in missing
        )
        fix = f"examine it with them: gazelle doctor {file} {argv}"
        phrase = f"RLException: [{file}] requires the '{missing[0].name}' arg to be set"
        _report(text, missing[0].span, fix, phrase, examination)
        return True
    return _report_passed_on(file, found, examination)


def without_consequences(found: Diagnostics) -> Iterator[Diagnostic]:
    """Yield what is wrong with a file in any case: with its arguments, too."""
    yield from (item for item in found if item.code not in _UNSET)


def _report_passed_on(file: Path, found: Diagnostics, examination: Examination) -> bool:
    """Tell of arguments that pass through includes, from outside or from the file around this."""
    outside = [item for item in found.by_code("launch.arg-missing") if _is_passed_on(item)]
    around = [
        item
        for item in found.by_code("launch.arg-undeclared")
        if _name(item) in _passed_in_package(file, examination)
    ]
    if not outside and not around:
        return False
    names = ", ".join(dict.fromkeys(map(_name, (*outside, *around))))
    text = f"'{file.name}' is not started: it takes the value of {names} from what starts or "
    text += "includes it (pass_all_args)"
    first = (*outside, *around)[0]
    fix = "examine the file that includes it, or give them: name:=value"
    _report(text, first.span, fix, first.phrase, examination)
    return True


def _report(
    text: str, span: SourceSpan | None, fix: str, phrase: str, examination: Examination
) -> None:
    code = "doctor.needs-arguments"
    examination.diagnostics.report(code, text, span, fix=fix, phrase=phrase)


def _name(item: Diagnostic) -> str:
    found = _QUOTED.search(item.message)
    return found[1] if found else ""


def _is_passed_on(item: Diagnostic) -> bool:
    """Tell whether the include that lacks a value hands on whatever it is given."""
    place = item.span.via[0] if item.span is not None and item.span.via else None
    root = read_xml(Path(place.file), Diagnostics()) if place is not None else None
    if place is None or root is None:
        return False
    return any(
        tag.span.line == place.line and tag.attributes.get("pass_all_args", "") in {"true", "1"}
        for tag in root.walk()
        if tag.name == "include"
    )


def _passed_in_package(file: Path, examination: Examination) -> frozenset[str]:
    """Return the arguments of launch files of the package that hand all of theirs on."""
    package = package_at(file.parent, examination.workspace)
    folder = package.path if package is not None else file.parent
    names: set[str] = set()
    for pattern in ("*.launch", "*.launch.xml"):
        for other in folder.rglob(pattern):
            root = read_xml(other, Diagnostics()) if other != file else None
            tags = tuple(root.walk()) if root is not None else ()
            if any("pass_all_args" in tag.attributes for tag in tags if tag.name == "include"):
                found = (tag.attributes.get("name", "") for tag in tags if tag.name == "arg")
                names.update(found)
    return frozenset(names)
