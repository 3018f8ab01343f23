"""``catkin_create_pkg``: a new package of ROS 1."""

from __future__ import annotations

import argparse
import getpass
import re
import sys
from pathlib import Path

from gazelle.workspace.scaffold import ScaffoldError
from gazelle.workspace.scaffold.catkin_package import CatkinPackage, write_catkin_package

__all__ = ["main"]

_NAME = re.compile(r"[a-z][a-z0-9_-]*")
_POSSIBLE = re.compile(r"[A-Za-z][\w-]*")
_VERSION = re.compile(r"\d+\.\d+\.\d+")


def main(argv: list[str]) -> int:
    """Write the package and say what was made."""
    parser = _parser()
    options = parser.parse_intermixed_args(argv)
    if not _VERSION.fullmatch(options.pkg_version):
        parser.error(f'Package version "{options.pkg_version}" does not follow version conventions')
    if not _POSSIBLE.fullmatch(options.name):
        parser.error(f"'{options.name}' is no name: letters, digits, '_' and '-', a letter first")
    if not _NAME.fullmatch(options.name):
        print(
            f'WARNING: Package name "{options.name}" does not follow the naming conventions. It '
            "should start with a lower case letter and only contain lower case letters, digits, "
            "underscores, and dashes.",
            file=sys.stderr,
        )
    package = CatkinPackage(
        options.name,
        tuple(dict.fromkeys(options.dependencies)),
        tuple(options.sys_deps),
        tuple(options.boost_comps),
        options.pkg_version,
        options.description or "",
        tuple(options.license),
        tuple(options.author),
        tuple(options.maintainer) or (_user(),),
        options.meta,
    )
    try:
        folder = write_catkin_package(package, Path.cwd(), print)
    except ScaffoldError as error:
        parser.error(str(error))
    print(f"Successfully created files in {folder}. Please adjust the values in package.xml.")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="catkin_create_pkg", description="Creates a new catkin package"
    )
    add = parser.add_argument
    add("name", help="The name for the package")
    add("--meta", action="store_true", help="Creates meta-package files")
    add("dependencies", nargs="*", help="Catkin package Dependencies")
    add("-s", "--sys-deps", nargs="*", default=[], help="System Dependencies")
    add("-b", "--boost-comps", nargs="*", default=[], help="Boost Components")
    add("-V", "--pkg_version", default="0.0.0", help="Initial Package version")
    add("-D", "--description", help="Description")
    add("-l", "--license", action="append", default=[], help="Name for License, (e.g. BSD, MIT)")
    add("-a", "--author", action="append", default=[], help="A single author, may be repeated")
    add("-m", "--maintainer", action="append", default=[],
        help="A single maintainer, may be repeated")  # fmt: skip
    return parser


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # nobody with this number in /etc/passwd
        return "maintainer"
