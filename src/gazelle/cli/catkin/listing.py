"""``catkin list`` and ``catkin locate``."""

from __future__ import annotations

import argparse
from pathlib import Path

from gazelle.cli.catkin.profile import Profile, load_profile
from gazelle.diagnostics import Diagnostics, did_you_mean, render
from gazelle.workspace.building.packages import (
    BuildError,
    SourcePackage,
    find_packages,
    in_order,
)

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Run the verb that the first word names."""
    parser = argparse.ArgumentParser(prog=f"catkin {words[0]}")
    parser.add_argument("-w", "--workspace", type=Path, help="the workspace")
    return _list(parser, words[1:]) if words[0] == "list" else _locate(parser, words[1:])


def _list(parser: argparse.ArgumentParser, words: list[str]) -> int:
    parser.add_argument("-u", "--unformatted", action="store_true", help="without '- '")
    parser.add_argument("--deps", action="store_true", help="with what they need")
    options = parser.parse_args(words)
    for item in _packages(load_profile(options.workspace or Path.cwd())):
        print(item.name if options.unformatted else f"- {item.name}")
        for role in ("build", "run") if options.deps else ():
            names = sorted(item.depends(role))
            print("".join([f"  {role}_depend:\n", *(f"  - {name}\n" for name in names)]), end="")
    return 0


def _locate(parser: argparse.ArgumentParser, words: list[str]) -> int:
    for letter, name in (("s", "src"), ("b", "build"), ("d", "devel"), ("i", "install")):
        parser.add_argument(f"-{letter}", f"--{name}", action="store_const", const=name, dest="of")
    parser.add_argument("package", nargs="?", help="a package of the workspace")
    options = parser.parse_args(words)
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
