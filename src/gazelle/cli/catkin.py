"""``catkin``: the verbs of catkin tools."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.cli.compile_step import compile_step_for
from gazelle.diagnostics import Diagnostics, did_you_mean, render
from gazelle.documents import read_limited
from gazelle.documents.yaml import YamlError, dump_yaml, load_yaml
from gazelle.workspace.building.build import Outcome, run_jobs
from gazelle.workspace.building.catkin_space import (
    CatkinSpaces,
    build_catkin_package,
    write_space_scripts,
)
from gazelle.workspace.building.packages import (
    BuildError,
    SourcePackage,
    find_packages,
    in_order,
    needed_by,
)

__all__ = [
    "Profile",
    "build",
    "clean",
    "create_pkg",
    "init_or_config",
    "list_or_locate",
    "load_profile",
    "main",
]

_MARKER = ".catkin_tools"
_CONFIG = "profiles/default/config.yaml"
_MAX_BYTES = 1 << 20
_SPACES = {"source_space": "src", "build_space": "build", "devel_space": "devel",
           "install_space": "install"}  # fmt: skip
_RULE = "-" * 62
_SPACE_NAMES = ("source", "build", "devel", "install")
_WIDTH = 40


class Profile(NamedTuple):
    """A workspace and its configuration.

    Attributes:
        root: the workspace.
        values: what ``catkin config`` stored, with its keys.
    """

    root: Path
    values: Mapping[str, Any]

    @property
    def installs(self) -> bool:
        """``catkin config --install``."""
        return self.values.get("install") is True

    @property
    def spaces(self) -> CatkinSpaces:
        """The folders of the workspace."""
        names = (str(self.values.get(key) or default) for key, default in _SPACES.items())
        return CatkinSpaces(*(self.root / name for name in names))


def main(argv: list[str]) -> int:
    """Run ``catkin VERB …``."""
    name = argv[0] if argv else ""
    if name in {"", "-h", "--help"}:
        lines = [f"  {verb:<8}{text}" for verb, (_, text) in _VERBS.items()]
        print("\n".join(["usage: catkin VERB ...", "", "catkin verbs:", *lines]))
        return 0 if name else 1
    if name not in _VERBS:
        hint = did_you_mean(name, _VERBS) or f"choose from {', '.join(map(repr, _VERBS))}"
        print(f"catkin: error: invalid choice: '{name}' ({hint})", file=sys.stderr)
        return 2
    return _VERBS[name][0](argv)


def load_profile(folder: Path, *, may_make: bool = False) -> Profile:
    """Return the workspace that a folder is in.

    Args:
        folder: in the workspace, or its top.
        may_make: make one of the folder when it has a ``src``, as ``catkin build`` does.

    Raises:
        BuildError: there is none, or its configuration cannot be read.
    """
    here = folder.resolve()
    root = next((item for item in (here, *here.parents) if (item / _MARKER).is_dir()), None)
    if root is None and may_make and (here / "src").is_dir():
        _make_workspace(here)
        root = here
    if root is None:
        raise BuildError(
            f"No catkin workspace found that contains '{here}'; run 'catkin init' in its top folder"
        )
    file = root / _MARKER / _CONFIG
    try:
        values = load_yaml(read_limited(file, _MAX_BYTES)) if file.is_file() else {}
    except (OSError, ValueError, YamlError) as error:
        raise BuildError(f"cannot read '{file}': {error}; remove it to start anew") from error
    return Profile(root, values if isinstance(values, dict) else {})


def init_or_config(argv: list[str]) -> int:
    """Run the verb that the first word names."""
    parser = argparse.ArgumentParser(prog=f"catkin {argv[0]}")
    parser.add_argument("-w", "--workspace", type=Path, help="the workspace")
    if argv[0] == "init":
        folder = parser.parse_args(argv[1:]).workspace or Path.cwd()
        root = folder.absolute()
        made = _make_workspace(root)
        what = "Initializing" if made else "already initialized:"
        print(f"{what} catkin workspace in `{root}`.")
        print(_summary(load_profile(root)))
        return 0
    return _config(parser, argv[1:])


def build(argv: list[str]) -> int:
    """Build the packages named, or all."""
    options = _parser().parse_args([word for word in argv[1:] if not word.startswith("-D")])
    pairs = (word[2:].partition("=") for word in argv if word.startswith("-D"))
    definitions = {name.partition(":")[0]: value for name, _, value in pairs}
    profile = load_profile(options.workspace or Path.cwd(), may_make=True)
    begin = time.monotonic()
    print(_summary(profile))
    everything, chosen = _packages_to_build(profile, options)
    took = time.monotonic() - begin
    print(f"[build] Found {len(everything)} packages in {took:.1f} seconds.", flush=True)
    outcomes: list[Outcome] = []

    def ended(outcome: Outcome) -> None:
        outcomes.append(outcome)
        _print_end(outcome)

    step = compile_step_for(chosen, definitions, command="catkin build")
    left = run_jobs(
        chosen,
        lambda item: build_catkin_package(
            item,
            profile.spaces,
            definitions,
            installs=profile.installs,
            compile_step=step,
            workspace=everything,
        ),
        everything=everything,
        workers=options.jobs or os.cpu_count() or 1,
        started=lambda name: print(f"Starting  >>> {name}", flush=True),
        ended=ended,
        continue_on_error=options.continue_on_failure,
    )
    _write_spaces(profile)
    _print_summary(outcomes, left, time.monotonic() - begin)
    return 1 if any(outcome.code for outcome in outcomes) else 0


def clean(argv: list[str]) -> int:
    """Ask, unless told not to, and remove the spaces."""
    parser = argparse.ArgumentParser(prog="catkin clean")
    parser.add_argument("-w", "--workspace", type=Path, help="the workspace")
    parser.add_argument("-y", "--yes", action="store_true", help="do not ask")
    parser.add_argument("-n", "--dry-run", action="store_true", help="say what would be removed")
    options = parser.parse_args(argv[1:])
    profile = load_profile(options.workspace or Path.cwd())
    spaces = profile.spaces
    there = [path for path in (spaces.build, spaces.devel, spaces.install) if path.is_dir()]
    for path in there:
        # A space such as '.' or one that is the source space would take the sources along.
        is_inside = profile.root in path.resolve().parents
        if not is_inside or path in (spaces.source, *spaces.source.parents):
            raise BuildError(
                f"'{path}' is not a folder of the workspace apart from its sources; it is not "
                "removed"
            )
        print(f"[clean] Removing {path}")
    if options.dry_run or not there:
        print("[clean] Nothing was removed.")
        return 0
    if not options.yes and not _agreed():
        print("[clean] Not removing the spaces.")
        return 1
    for path in there:
        shutil.rmtree(path)
    return 0


def create_pkg(argv: list[str]) -> int:
    """Write packages with the options of ``catkin_create_pkg``."""
    from gazelle.cli import catkin_create_pkg

    if argv[1:2] != ["pkg"]:
        print("usage: catkin create pkg PKG_NAME [--catkin-deps DEP ...]", file=sys.stderr)
        return 2
    parser = argparse.ArgumentParser(prog="catkin create pkg")
    parser.add_argument("name", metavar="PKG_NAME")
    parser.add_argument("-c", "--catkin-deps", nargs="*", default=[], metavar="DEP")
    options, rest = parser.parse_known_args(argv[2:])
    return catkin_create_pkg.main([options.name, *options.catkin_deps, *rest])


def list_or_locate(argv: list[str]) -> int:
    """Run the verb that the first word names."""
    parser = argparse.ArgumentParser(prog=f"catkin {argv[0]}")
    parser.add_argument("-w", "--workspace", type=Path, help="the workspace")
    return _list(parser, argv[1:]) if argv[0] == "list" else _locate(parser, argv[1:])


def _make_workspace(root: Path) -> bool:
    """Make a folder a workspace; False when it is one already."""
    marker = root / _MARKER
    if marker.is_dir():
        return False
    (marker / "profiles/default").mkdir(parents=True)
    (marker / "CATKIN_IGNORE").touch()
    return True


def _save_profile(profile: Profile) -> None:
    """Store the configuration."""
    file = profile.root / _MARKER / _CONFIG
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(dump_yaml(dict(profile.values)), encoding="utf-8")


def _summary(profile: Profile) -> str:
    """Return the table that catkin tools print before a build."""
    lines = [_RULE, "Profile:                     default"]
    lines += [f"Workspace:                   {profile.root}", _RULE]
    for label, path in zip(("Build", "Devel", "Install", "Source"), _in_table_order(profile),
                           strict=True):  # fmt: skip
        state = "exists" if path.is_dir() else "missing"
        if label == "Install" and not profile.installs:
            state = "unused"
        lines.append(f"{label + ' Space:':<20}[{state}]".ljust(30) + str(path))
    lines += [_RULE, f"Install Space Used:          {profile.installs}", _RULE]
    return "\n".join(lines)


def _config(parser: argparse.ArgumentParser, argv: list[str]) -> int:
    installs = parser.add_mutually_exclusive_group()
    installs.add_argument("--install", action="store_true", default=None, dest="installs")
    installs.add_argument("--no-install", action="store_false", default=None, dest="installs")
    for name in _SPACE_NAMES:
        parser.add_argument(f"--{name}-space", metavar="FOLDER")
    parser.add_argument("--init", action="store_true", help="make the workspace first")
    options = parser.parse_args(argv)
    folder = options.workspace or Path.cwd()
    if options.init:
        _make_workspace(folder.absolute())
    profile = load_profile(folder)
    values = dict(profile.values)
    if options.installs is not None:
        values["install"] = options.installs
    for name in _SPACE_NAMES:
        given = getattr(options, f"{name}_space")
        if given is not None:
            values[f"{name}_space"] = given
    profile = Profile(profile.root, values)
    _save_profile(profile)
    print(_summary(profile))
    return 0


def _in_table_order(profile: Profile) -> tuple[Path, Path, Path, Path]:
    spaces = profile.spaces
    return spaces.build, spaces.devel, spaces.install, spaces.source


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="catkin build", description="Builds a catkin workspace.")
    add = parser.add_argument
    add("packages", nargs="*", metavar="PKGNAME", help="these packages and what they need")
    add("-w", "--workspace", type=Path, help="the workspace (the one around the current folder)")
    add("--this", action="store_true", help="the package around the current folder")
    add("--no-deps", action="store_true", help="only the packages named")
    add("-c", "--continue-on-failure", action="store_true", help="go on when a package fails")
    add("-j", "--jobs", type=int, help="how many packages at a time")
    add("--cmake-args", action="store_true", help="-DNAME=VALUE … follow")
    return parser


def _packages_to_build(
    profile: Profile, options: argparse.Namespace
) -> tuple[tuple[SourcePackage, ...], tuple[SourcePackage, ...]]:
    diagnostics = Diagnostics()
    source = profile.spaces.source
    if not source.is_dir():
        raise BuildError(f"the source space '{source}' does not exist")
    everything = in_order(find_packages([source], diagnostics))
    if len(diagnostics):
        render(diagnostics)
    names = list(options.packages)
    if options.this:
        here = Path.cwd()
        around = [item.name for item in everything if item.path in (here, *here.parents)]
        if not around:
            raise BuildError(f"--this: '{here}' is in no package of the workspace")
        names += around
    known = {item.name for item in everything}
    for name in names:
        if name not in known:
            hint = did_you_mean(name, known)
            text = f"Given package '{name}' is not in the workspace"
            raise BuildError(f"{text}; {hint}" if hint else text)
    wanted = set(names) if options.no_deps else needed_by(names, everything)
    return everything, tuple(item for item in everything if item.name in wanted or not names)


def _print_end(outcome: Outcome) -> None:
    if outcome.errors:
        lines = ["_" * 79, f"{'Errors' if outcome.code else 'Warnings'} << {outcome.name}"]
        print("\n".join([*lines, *outcome.errors, "." * 79]), file=sys.stderr, flush=True)
    label = "Failed    << " if outcome.code else "Finished  <<<"
    print(f"{label} {outcome.name:<{_WIDTH}} [ {outcome.duration_s:.1f} seconds ]", flush=True)


def _write_spaces(profile: Profile) -> None:
    spaces = profile.spaces
    try:
        spaces.build.mkdir(parents=True, exist_ok=True)
        (spaces.build / "CATKIN_IGNORE").touch()
        write_space_scripts(spaces.devel, (spaces.source,), os.environ)
        if profile.installs:
            write_space_scripts(spaces.install, (), os.environ)
    except OSError as error:
        raise BuildError(f"cannot write '{error.filename}': {error.strerror}") from error


def _print_summary(outcomes: Sequence[Outcome], left: Sequence[str], took_s: float) -> None:
    failed = [item.name for item in outcomes if item.code]
    good = len(outcomes) - len(failed)
    total = len(outcomes) + len(left)
    verdict = f"All {total} packages succeeded!" if good == total else (
        f"{good} of {total} packages succeeded.")  # fmt: skip
    warned = [item.name for item in outcomes if item.errors and not item.code]
    print(f"[build] Summary: {verdict}")
    for label, names in (("Warnings", warned), ("Abandoned", left), ("Failed", failed)):
        print(f"[build]   {label + ':':<11}{', '.join(names) or 'None.'}")
    print(f"[build] Runtime: {took_s:.1f} seconds total.", flush=True)


def _agreed() -> bool:
    print("[clean] Are you sure you want to remove these folders? [y/N]: ", end="", flush=True)
    return sys.stdin.readline().strip().lower() in {"y", "yes"}


def _list(parser: argparse.ArgumentParser, argv: list[str]) -> int:
    parser.add_argument("-u", "--unformatted", action="store_true", help="without '- '")
    parser.add_argument("--deps", action="store_true", help="with what they need")
    options = parser.parse_args(argv)
    for item in _packages(load_profile(options.workspace or Path.cwd())):
        print(item.name if options.unformatted else f"- {item.name}")
        for role in ("build", "run") if options.deps else ():
            names = sorted(item.depends(role))
            print("".join([f"  {role}_depend:\n", *(f"  - {name}\n" for name in names)]), end="")
    return 0


def _locate(parser: argparse.ArgumentParser, argv: list[str]) -> int:
    for letter, name in (("s", "src"), ("b", "build"), ("d", "devel"), ("i", "install")):
        parser.add_argument(f"-{letter}", f"--{name}", action="store_const", const=name, dest="of")
    parser.add_argument("package", nargs="?", help="a package of the workspace")
    options = parser.parse_args(argv)
    profile = load_profile(options.workspace or Path.cwd())
    spaces = profile.spaces
    places = {"src": spaces.source, "build": spaces.build, "devel": spaces.devel,
              "install": spaces.install, None: profile.root}  # fmt: skip
    if options.package is None:
        print(places[options.of])
        return 0
    known = {item.name: item for item in _packages(profile)}
    if options.package not in known:
        hint = did_you_mean(options.package, known)
        raise BuildError(f"no package '{options.package}' in the workspace; {hint}".rstrip("; "))
    share = places[options.of] / "share" / options.package
    print(known[options.package].path if options.of in {None, "src"} else share)
    return 0


def _packages(profile: Profile) -> tuple[SourcePackage, ...]:
    diagnostics = Diagnostics()
    found = in_order(find_packages([profile.spaces.source], diagnostics))
    if len(diagnostics):
        render(diagnostics)
    return found


# Each function takes the words, the verb first.
_VERBS = {
    "build": (build, "Builds a catkin workspace"),
    "clean": (clean, "Deletes what a build has made"),
    "config": (init_or_config, "Configures a catkin workspace"),
    "create": (create_pkg, "Creates a catkin package"),
    "init": (init_or_config, "Makes a folder a catkin workspace"),
    "list": (list_or_locate, "Lists catkin packages"),
    "locate": (list_or_locate, "Gets the path of a package or space"),
}
