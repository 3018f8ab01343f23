"""``rospack`` and ``rosversion``: what packages there are and where."""

from __future__ import annotations

import sys

from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.workspace import Package, Workspace

__all__ = ["main"]

_USAGE = """USAGE: rospack <command> [options] [package]
  Allowed commands:
    help
    find [package]
    list
    list-names
    depends1 [package]   (alias: deps1)
    depends [package]    (alias: deps)
    depends-on1 [package]
    profile"""


def main(argv: list[str]) -> int:
    """Run ``rospack`` or ``rosversion``, which the first word says."""
    name, *tokens = argv
    workspace = Workspace.discover()
    if name == "rosversion":
        return _version(tokens, workspace)
    if not tokens or tokens[0] in {"help", "-h", "--help"}:
        print(_USAGE)
        return 0
    return _command(tokens[0], tokens[1:], workspace)


def _command(command: str, argv: list[str], workspace: Workspace) -> int:
    if command == "list":
        for package in _sorted(workspace):
            print(f"{package.name} {package.path}")
    elif command == "list-names":
        print("\n".join(package.name for package in _sorted(workspace)))
    elif command == "profile":
        print(f"{len(workspace.packages)} packages")
    elif command in {"find", "depends1", "deps1", "depends", "deps", "depends-on1"} and argv:
        return _about(command, argv[-1], workspace)
    else:
        print(f"[rospack] Error: command {command} not supported", file=sys.stderr)
        print(_USAGE, file=sys.stderr)
        return 1
    return 0


def _about(command: str, name: str, workspace: Workspace) -> int:
    try:
        package = workspace.package(name)
    except NotFoundError as error:
        print(f"[rospack] Error: package '{name}' not found", file=sys.stderr)
        print(error, file=sys.stderr)
        return 1
    if command == "find":
        print(package.share)
    elif command == "depends-on1":
        users = [item.name for item in _sorted(workspace) if name in item.depends]
        print("\n".join(users), end="\n" if users else "")
    else:
        found = _depends(package, workspace, deep=command in {"depends", "deps"})
        print("\n".join(found), end="\n" if found else "")
    return 0


def _depends(package: Package, workspace: Workspace, *, deep: bool) -> list[str]:
    """Return the names of what a package needs, those that are here, nearest first."""
    found: dict[str, None] = {}
    waiting = [name for name in package.depends if name in workspace.packages]
    while waiting:
        name = waiting.pop(0)
        if name not in found:
            found[name] = None
            if deep:
                more = workspace.packages[name].depends
                waiting += [item for item in more if item in workspace.packages]
    return list(found)


def _sorted(workspace: Workspace) -> list[Package]:
    return sorted(workspace.packages.values(), key=lambda item: item.name)


def _version(argv: list[str], workspace: Workspace) -> int:
    if argv in (["-d"], ["--distro"]):
        print("noetic")
        return 0
    if not argv or argv[0].startswith("-"):
        print("usage: rosversion [-d] [package]")
        return 0 if argv and argv[0] in {"-h", "--help"} else 2
    if argv[0] not in workspace.packages:
        near = nearest_names(argv[0], workspace.packages)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        print(f"Cannot locate [{argv[0]}]{hint}", file=sys.stderr)
        return 1
    print(workspace.packages[argv[0]].version or "<unversioned>")
    return 0
