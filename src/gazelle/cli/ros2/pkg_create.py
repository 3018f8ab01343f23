"""``ros2 pkg create``: a new package of ROS 2."""

from __future__ import annotations

import argparse
import getpass
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from gazelle.workspace.scaffold import ScaffoldError, check_package_name
from gazelle.workspace.scaffold.ros2_package import BUILD_TYPES, Ros2Package, write_ros2_package

__all__ = ["add_arguments", "main", "run"]

# ament_copyright's, by SPDX identifier.
_LICENSES = (
    "Apache-2.0", "BSL-1.0", "BSD-2.0", "BSD-2-Clause", "BSD-3-Clause", "GPL-3.0-only",
    "LGPL-3.0-only", "MIT", "MIT-0",
)  # fmt: skip
_CMAKE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_TODO_LICENSE = "TODO: License declaration"
_LICENSE_TEXT = """SPDX-License-Identifier: {0}

The text of this license is at https://spdx.org/licenses/{0}.html; put it here before you publish.
"""


def main(argv: list[str]) -> int:
    """Run ``ros2 pkg create …``; the words behind ``create`` are given."""
    parser = argparse.ArgumentParser(
        prog="ros2 pkg create", description="Create a new ROS 2 package"
    )
    add_arguments(parser)
    return run(parser.parse_args(argv))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    add = parser.add_argument
    add("package_name", help="The package name")
    add("--package-format", "--package_format", type=int, default=3, choices=[2, 3],
        help="The package.xml format.")  # fmt: skip
    add("--description", default="TODO: Package description",
        help="The description given in the package.xml")  # fmt: skip
    add("--license", default=_TODO_LICENSE,
        help="The license attached to this package; '?' lists those known")  # fmt: skip
    add("--destination-directory", default=os.curdir,
        help="Directory where to create the package directory")  # fmt: skip
    add("--build-type", default="ament_cmake", choices=BUILD_TYPES,
        help="The build type to process the package with")  # fmt: skip
    add("--dependencies", nargs="+", default=[], help="list of dependencies")
    add("--maintainer-email", help="email address of the maintainer of this package")
    add("--maintainer-name", default=_user(), help="name of the maintainer of this package")
    add("--node-name", help="name of the empty executable")
    add("--library-name", help="name of the empty library")


def run(options: argparse.Namespace) -> int:
    """Create the package."""
    if options.license == "?":
        print("Supported licenses:\n" + "\n".join(_LICENSES))
        return 0
    problem = _problem(options)
    if problem:
        print(problem, file=sys.stderr)
        return 1
    package = _package(options)
    _announce(package, options.destination_directory)
    folder = write_ros2_package(package, options.destination_directory, print)
    _write_license(package.license, folder)
    return 0


def _problem(options: argparse.Namespace) -> str:
    name = options.package_name
    if options.build_type == "ament_python" and name == "test":
        return (
            "Aborted since 'ament_python' packages can't be named 'test'. Please "
            "choose a different package name."
        )
    path = os.path.join(options.destination_directory, name)  # noqa: PTH118 - printed as given
    if Path(path).exists():
        return (
            f"\nAborted!\nThe directory already exists: {path}\nEither remove the directory or "
            "choose a different destination directory or package name"
        )
    try:
        check_package_name(name)
    except ScaffoldError as error:
        # What is no name of a Python module makes a package whose nodes never start.
        if options.build_type == "ament_python" or not _CMAKE_NAME.fullmatch(name):
            return f"Aborted: {error}"
        print(f"[WARNING] {error}", file=sys.stderr)
    for word in (options.node_name, options.library_name):
        if word and not word.isidentifier():
            return f"Aborted: '{word}' is no name for a source file: letters, digits, underscores"
    return ""


def _package(options: argparse.Namespace) -> Ros2Package:
    node, library = options.node_name or "", options.library_name or ""
    if node and node == library:
        node += "_node"
        print("[WARNING] node name can not be equal to the library name", file=sys.stderr)
        print(f"[WARNING] renaming node to {node}", file=sys.stderr)
    return Ros2Package(
        name=options.package_name,
        build_type=options.build_type,
        depends=tuple(options.dependencies),
        node=node,
        library=library,
        description=options.description,
        license=options.license,
        maintainer=options.maintainer_name,
        email=options.maintainer_email or _git_email() or f"{options.maintainer_name}@todo.todo",
        format=options.package_format,
    )


def _announce(package: Ros2Package, destination: str) -> None:
    print("going to create a new package")
    print("package name:", package.name)
    print("destination directory:", Path(destination).absolute().resolve())
    print("package format:", package.format)
    print("version: 0.0.0")
    print("description:", package.description)
    print("maintainer:", [f"{package.maintainer} <{package.email}>"])
    print("licenses:", [package.license])
    print("build type:", package.build_type)
    print("dependencies:", list(package.depends))
    if package.node:
        print("node_name:", package.node)
    if package.library:
        print("library_name:", package.library)


def _write_license(name: str, folder: Path) -> None:
    if name in _LICENSES:
        (folder / "LICENSE").write_text(_LICENSE_TEXT.format(name), encoding="utf-8")
        return
    listed = "\n".join(_LICENSES)
    print(
        f"\n[WARNING]: Unknown license '{name}'.  This has been set in the package.xml, but "
        "no LICENSE file has been created.\nIt is recommended to use one of the ament "
        f"license identifiers:\n{listed}"
    )


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # nobody with this number in /etc/passwd
        return "maintainer"


def _git_email() -> str:
    git = shutil.which("git")
    if git is None:
        return ""
    done = subprocess.run(
        [git, "config", "user.email"], capture_output=True, text=True, check=False
    )
    return done.stdout.strip()
