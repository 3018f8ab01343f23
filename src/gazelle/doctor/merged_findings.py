"""Findings of many files that are one fact, said once: what is not here, what was not run."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import PurePath

from gazelle.diagnostics import Diagnostic, Diagnostics, nearest_names
from gazelle.doctor.packages.dependency_checks import is_ros_package, is_slip, known_packages

__all__ = ["condensed"]

_PACKAGE = re.compile(r"package '([^'\n]+)' not found")
_ELSEWHERE = re.compile(r"packages that are not in this workspace: ([^;\n]+);")
_MODEL = re.compile(
    r"'model://([^/'\n]+)[^'\n]*' not found: "
    r"(?:there is no model '|'[^'\n]*' is a model of Gazebo's|plain shapes stand in for Gazebo's)"
)
_ASKED = re.compile(r"did you mean ([^?\n]+)\?")
_QUOTED = re.compile(r"'([^'\n]+)'")
_MATERIAL = re.compile(r"material '([^'/\n]+)/[^'\n]*' is not known")
_NODE = re.compile(r"node of type \[([^]]+)\] in package \[([^]]+)\]")
_CLASS = re.compile(r"Could not load class '([^'\n]+)'")
_LIBRARY = re.compile(r"plug-in '([^'\n]*)'")
_MODEL_CODES = frozenset({"material.script-missing", "sdf.missing-file", "sdf.missing-model"})
_PLUGIN_CODES = ("plugin.compiled", "plugin.unknown")
# The table of plug-ins says it.
_IN_TABLES = frozenset({"plugin.built-in"})
_DISAGREE = "control.names-disagree"
_INCLUDE = re.compile(r"include that file above: .*")
_MACRO = re.compile(r"unknown macro name: (\S+)")
_YAML = (".yaml", ".yml")
_PLACES_SHOWN = 3
_NAMES_SHOWN = 12

Name = Callable[[Diagnostic], str]


def condensed(findings: Sequence[Diagnostic], packages: Iterable[str] = ()) -> list[Diagnostic]:
    """Return findings with those about one fact made one, at the place of the first.

    What stands in the user's files keeps its places. Put together is what is true of the whole
    examination: packages of ROS that are not on this machine, models of Gazebo's collection,
    nodes that nothing compiles, plug-ins by library, launch files that were read and not run.

    Args:
        findings: in the order found.
        packages: names that exist: packages of the workspace and those its manifests name.
    """
    known = frozenset(packages) | known_packages()
    kept = [item for item in findings if item.code not in _IN_TABLES]
    kept = _packages(kept, known)
    kept = _of_one_code(kept, "launch_ros2.packages-elsewhere", _elsewhere)
    kept = _of_one_code(kept, "launch_ros2.static", _static)
    kept = _of_one_code(kept, "launch.compiled-node", _compiled_nodes)
    kept = _by_name(kept, "doctor.controller-fails", _CLASS, "the same class")
    kept = _models(kept)
    kept = _disagreements(kept)
    kept = _unincluded(kept)
    kept = _of_one_place(kept)
    for code in _PLUGIN_CODES:
        kept = _by_name(kept, code, _LIBRARY, "the same library")
    return [_with_few_places(item) for item in kept]


def _of_one_code(
    findings: list[Diagnostic], code: str, together: Callable[[list[Diagnostic]], Diagnostic]
) -> list[Diagnostic]:
    group = [item for item in findings if item.code == code]
    if len(group) < 2:
        return findings
    return _replaced(findings, group, together(group))


def _replaced(
    findings: list[Diagnostic], group: list[Diagnostic], one: Diagnostic
) -> list[Diagnostic]:
    """Return findings with a group gone and one finding at the place of its first."""
    gone = {id(item) for item in group}
    return [
        one if item is group[0] else item
        for item in findings
        if item is group[0] or id(item) not in gone
    ]


_NOT_HERE = (
    "launch.package-elsewhere",
    "launch.package-missing",
    "ros2_launch.package-missing",
)


def _packages(findings: list[Diagnostic], known: frozenset[str]) -> list[Diagnostic]:
    """Tell packages that are not here from names that are wrong."""
    group = [
        item for item in findings if item.code in _NOT_HERE and _is_elsewhere(_package(item), known)
    ]
    if not group:
        return findings
    uses = _listed(_counted(group, _package))
    text = f"packages that are not here and that Gazelle does not bring along: {uses}; "
    text += "what launch files take from them is not started here"
    made = Diagnostics()
    made.report("doctor.packages-elsewhere", text, group[0].span)
    return _replaced(findings, group, next(iter(made)))


def _is_elsewhere(name: str, known: frozenset[str]) -> bool:
    if not name or name in known or is_ros_package(name):
        return bool(name)
    near = nearest_names(name, known, count=1)
    return not (near and is_slip(name, near[0]))


def _package(item: Diagnostic) -> str:
    found = _PACKAGE.search(item.message)
    return found[1] if found else ""


def _counted(group: Iterable[Diagnostic], name: Name) -> list[str]:
    """Return each name with the files that use it."""
    files: dict[str, dict[str, None]] = {}
    for item in group:
        place = PurePath(item.span.file).name if item.span else ""
        files.setdefault(name(item), {})[place] = None
    return [f"{key} ({', '.join(_some(list(files[key])))})" for key in sorted(files)]


def _elsewhere(group: list[Diagnostic]) -> Diagnostic:
    names: set[str] = set()
    for item in group:
        found = _ELSEWHERE.search(item.message)
        names |= set(found[1].split(", ")) if found else set()
    text = f"packages that are not in this workspace: {', '.join(sorted(names))}; what the "
    return replace(group[0], message=text + "launch files take from them cannot be looked at")


def _static(group: list[Diagnostic]) -> Diagnostic:
    text = f"{len(group)} launch files were read, not run: what their Python computes from the "
    return replace(group[0], span=None, message=text + "outside, and conditions, are not known")


def _compiled_nodes(group: list[Diagnostic]) -> Diagnostic:
    names = dict.fromkeys("/".join(reversed(_node(item))) for item in group)
    if len(names) == 1:
        return group[0]
    text = f"Cannot locate node of {len(names)} types: they are compiled code that nothing "
    return replace(group[0], message=f"{text}builds: {_listed(list(names))}")


def _node(item: Diagnostic) -> tuple[str, str]:
    found = _NODE.search(item.message)
    return (found[1], found[2]) if found else (item.message, "")


def _models(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Say of each model once that it is not here, whatever of it is wanted."""
    missing = {name for item in findings for name in [_model(item)] if name}
    missing -= {name for item in findings for name in [_misspelt(item)] if name}
    owned = {_folded(name) for name in missing}
    group = [item for item in findings if _model(item) in missing or _material(item) in owned]
    if len(group) < 2:
        return findings
    files = {PurePath(item.span.file).name: None for item in group if item.span}
    what = f"{len(missing)} models are" if len(missing) > 1 else "a model is"
    text = f"{what} not here, and nothing is downloaded: {_listed(sorted(missing))}; meshes and "
    text += f"materials of them are left out in {', '.join(_some(list(files)))}"
    first = next(item for item in group if _model(item) in missing)
    fix = "put their folders into one that GAZEBO_MODEL_PATH names; Gazebo has them from "
    fix += "github.com/osrf/gazebo_models or Fuel"
    return _replaced(findings, [first, *(item for item in group if item is not first)],
                     replace(first, code="sdf.missing-model", message=text, fix=fix))  # fmt: skip


def _disagreements(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Say what robot and parameters disagree on where the parameters are, as severely as anywhere.

    A launch is told of it at the robot's plug-in, for it knows no files.
    """
    group = [item for item in findings if item.code == _DISAGREE]
    of_files = [item for item in group if item.span and item.span.file.endswith(_YAML)]
    for item in of_files:
        rows = _joints_of(item)
        late = [one for one in group if one not in of_files and _joints_of(one) <= rows]
        worst = max([item, *late], key=lambda one: one.severity).severity
        if late:
            findings = _replaced(findings, [item, *late], replace(item, severity=worst))
    return findings


def _unincluded(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Say once of a file that its macros are unknown where it is not included."""
    groups: dict[tuple[str, str], list[Diagnostic]] = {}
    for item in findings:
        found = _INCLUDE.search(item.fix) if item.code == "xacro.unknown-macro" else None
        if found and item.span is not None:
            groups.setdefault((item.span.file, found[0]), []).append(item)
    for (_, fix), group in groups.items():
        if len(group) > 1:
            names = {found[1]: None for item in group if (found := _MACRO.search(item.message))}
            text = f"unknown macro names: {_listed(list(names))}; no file with them is included"
            one = replace(group[0], message=text, fix=fix)
            findings = _replaced(findings, group, one)
    return findings


def _of_one_place(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Say once of a macro's line what is true of all that it makes: both wheels wobble."""
    groups: dict[tuple[str, int, str], list[Diagnostic]] = {}
    for item in findings:
        if item.code == "robot.wheel-axis" and item.span is not None and item.span.via:
            groups.setdefault((item.span.file, item.span.line, item.fix), []).append(item)
    for group in groups.values():
        if len(group) > 1:
            text = f"{group[0].message}\n  the same {_times(len(group) - 1)}"
            findings = _replaced(findings, group, replace(group[0], message=text))
    return findings


def _joints_of(item: Diagnostic) -> set[str]:
    return {line.split()[0] for line in item.message.split("\n")[2:] if line.split()}


def _model(item: Diagnostic) -> str:
    found = _MODEL.search(item.message) if item.code in _MODEL_CODES else None
    return found[1] if found else ""


def _misspelt(item: Diagnostic) -> str:
    """Return a model's name that is a slip for one that is here."""
    name = _model(item)
    asked = _ASKED.search(item.message) if name else None
    near = _QUOTED.findall(asked[1]) if asked else []
    return name if any(is_slip(name, one.removeprefix("model://")) for one in near) else ""


def _material(item: Diagnostic) -> str:
    found = _MATERIAL.search(item.message) if item.code == "material.unknown" else None
    return _folded(found[1]) if found else ""


def _folded(name: str) -> str:
    return name.replace("_", "").casefold()


def _by_name(
    findings: list[Diagnostic], code: str, pattern: re.Pattern[str], what: str
) -> list[Diagnostic]:
    """Say once of each library or class what becomes of everything that is of it."""
    groups: dict[str, list[Diagnostic]] = {}
    for item in findings:
        found = pattern.search(item.message)
        if item.code == code and found:
            groups.setdefault(found[1], []).append(item)
    for group in groups.values():
        if len(group) > 1:
            text = f"{group[0].message}\n  {what} {_times(len(group) - 1)}"
            findings = _replaced(findings, group, replace(group[0], message=text))
    return findings


def _times(count: int) -> str:
    return "in one more place" if count == 1 else f"in {count} more places"


def _with_few_places(item: Diagnostic) -> Diagnostic:
    """Shorten the places that were looked in: a workspace has dozens."""
    if "\n  looked in:\n" not in item.message:
        return item
    return replace(item, message="\n".join(_shortened(item.message.split("\n"))))


def _shortened(lines: Iterable[str]) -> Iterator[str]:
    in_list, count = False, 0
    for line in lines:
        is_place = in_list and line.startswith("    ")
        if in_list and not is_place and count > _PLACES_SHOWN:
            yield f"    … and {count - _PLACES_SHOWN} more"
        in_list, count = is_place or line == "  looked in:", count + 1 if is_place else 0
        if count <= _PLACES_SHOWN:
            yield line
    if in_list and count > _PLACES_SHOWN:
        yield f"    … and {count - _PLACES_SHOWN} more"


def _some(names: list[str]) -> list[str]:
    rest = len(names) - _PLACES_SHOWN
    return names[:_PLACES_SHOWN] + ([f"{rest} more"] if rest > 0 else [])


def _listed(names: list[str]) -> str:
    rest = len(names) - _NAMES_SHOWN
    return ", ".join(names[:_NAMES_SHOWN]) + (f" and {rest} more" if rest > 0 else "")
