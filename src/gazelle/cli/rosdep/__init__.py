"""``rosdep``: what the packages of a workspace need, and what of it is missing."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.diagnostics import Diagnostics, did_you_mean, render
from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace
from gazelle.workspace.building.packages import find_packages

if TYPE_CHECKING:
    from gazelle.cli.rosdep.keys import Answer

__all__ = ["main"]

_VERBS = {
    "check": "check if the dependencies of packages are met",
    "init": "nothing to do here; there is no list of sources",
    "install": "say what is missing, and what can be done about it",
    "keys": "list the keys that packages depend on",
    "resolve": "say what a key comes to",
    "update": "nothing to do here; nothing is downloaded",
}
_NOTHING = {
    "init": "Nothing to do: Gazelle has no list of sources.\n",
    "update": "Nothing to do: what Gazelle brings it knows itself, nothing is downloaded.\n",
}


def main(argv: list[str]) -> int:
    """Run ``rosdep VERB …``."""
    verb = argv[0] if argv else ""
    if verb in {"", "-h", "--help"}:
        lines = [f"  {name:<9}{text}" for name, text in _VERBS.items()]
        print("\n".join(["usage: rosdep VERB [options] <args>", "", *lines]))
        return 0 if verb else 64
    if verb not in _VERBS:
        hint = did_you_mean(verb, _VERBS)
        print(f"ERROR: unsupported command '{verb}'; {hint}".rstrip("; "), file=sys.stderr)
        return 64
    options = _parser(verb).parse_args(argv[1:])
    if verb in _NOTHING:
        print(_NOTHING[verb], end="")
        return 0
    if verb == "resolve":
        from gazelle.cli.rosdep.keys import judge

        workspace = Workspace.discover()
        for key in options.names:
            print(_line(judge(key, workspace, ())))
        return 0
    keys, own, problems = _keys(options)
    if problems:
        print("\n".join(problems), file=sys.stderr)
        return 1
    return _tell(verb, keys, own, options)


def _parser(verb: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=f"rosdep {verb}", description=_VERBS[verb])
    add = parser.add_argument
    add("names", nargs="*", help="keys" if verb == "resolve" else "packages")
    add("--from-paths", nargs="*", type=Path, default=[], metavar="PATH",
        help="all packages below these folders")  # fmt: skip
    add("-i", "--ignore-packages-from-source", "--ignore-src", action="store_true",
        help="leave out packages that are there in source")  # fmt: skip
    add("--skip-keys", action="append", default=[], metavar="KEYS", help="leave these out")
    add("-q", "--quiet", action="store_true", help="say only what is missing")
    add("-a", "--all", action="store_true", help="all packages of the workspace")
    # There is nothing to ask and nothing to install; scripts give these.
    for names in (["-y", "--default-yes"], ["-r"], ["-s", "--simulate"], ["-v", "--verbose"],
                  ["--reinstall"], ["--include-eol-distros"]):  # fmt: skip
        add(*names, action="store_true", help=argparse.SUPPRESS)
    for names in (["--rosdistro"], ["--os"], ["-t", "--dependency-types"]):
        add(*names, action="append", help=argparse.SUPPRESS)
    return parser


def _keys(options: argparse.Namespace) -> tuple[dict[str, list[str]], frozenset[str], list[str]]:
    """Return keys with the packages that name them, the packages looked at, what went wrong."""
    needs: dict[str, Iterable[str]] = {}
    problems = []
    diagnostics = Diagnostics()
    for item in find_packages(options.from_paths, diagnostics):
        needs[item.name] = item.depends()
    if len(diagnostics):
        render(diagnostics)
    workspace = Workspace.discover()
    if options.all:
        mine = workspace.user_packages
        needs |= {item.name: item.depends for item in mine}
    for name in options.names:
        try:
            needs[name] = workspace.package(name).depends
        except NotFoundError as error:
            text = "ERROR: Rosdep cannot find all required resources to answer your query"
            problems.append(f"{text}\nMissing resource {name}\n{error}")
    if not needs and not problems:
        problems.append("Please enter packages, or --from-paths FOLDER")
    skipped = {key for names in options.skip_keys for key in names.split()}
    found: dict[str, list[str]] = {}
    for name, keys in sorted(needs.items()):
        for key in set(keys) - skipped:
            found.setdefault(key, []).append(name)
    return found, frozenset(needs), problems


def _tell(
    verb: str, keys: dict[str, list[str]], own: frozenset[str], options: argparse.Namespace
) -> int:
    # What is known here is spread over all of Gazelle, and takes its time to load.
    from gazelle.cli.rosdep.keys import Kind, judge

    workspace = Workspace.discover()
    answers = [judge(key, workspace, own) for key in sorted(keys)]
    if options.ignore_packages_from_source:
        answers = [item for item in answers if item.kind is not Kind.SOURCE]
    if verb == "keys":
        print("".join(f"{item.key}\n" for item in answers), end="")
        return 0
    missing = [item for item in answers if not item.is_met]
    for kind in Kind:
        names = [item.key for item in answers if item.kind is kind and item.is_met]
        if names and not options.quiet:
            print(f"{kind.value}: {' '.join(names)}")
    for item in missing:
        print(f"{_line(item)}  [{' '.join(keys[item.key])}]")
    if verb == "check":
        verb = "have not" if missing else "have"
        print(f"All system dependencies {verb} been satisfied")
        return 1 if missing else 0
    if missing:
        count = len(missing)
        print(f"#Nothing was installed; {count} of {len(answers)} keys are not met, see above")
    else:
        print("#All required rosdeps installed successfully")
    return 0


def _line(answer: Answer) -> str:
    return f"{answer.key}: {answer.kind.value}" + (f"; {answer.advice}" if answer.advice else "")
