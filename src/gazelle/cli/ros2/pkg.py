"""``ros2 pkg``: what packages there are, what is in them, and new ones."""

from __future__ import annotations

import argparse
import re
import sys

from gazelle.cli.ros2.verbs import Command, Verb, run_command
from gazelle.cli.ros_tool import hint
from gazelle.cpp.lookup import built_file, cpp_program, cpp_programs
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.node_specs.registry import builtin_executables, builtin_packages
from gazelle.workspace import Package, Workspace

__all__ = [
    "add_arguments_executables",
    "add_arguments_list",
    "add_arguments_prefix",
    "add_arguments_xml",
    "main",
    "run_executables",
    "run_list",
    "run_prefix",
    "run_xml",
]

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_VERBS = {
    "create": Verb("Create a new ROS 2 package", "gazelle.cli.ros2.pkg_create"),
    "executables": Verb("Output a list of package specific executables", __name__),
    "list": Verb("Output a list of available packages", __name__),
    "prefix": Verb("Output the prefix path of a package", __name__),
    "xml": Verb("Output the XML of the package manifest or a specific tag", __name__),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 pkg``."""
    return run_command(Command("pkg", "Various package related sub-commands", _VERBS), argv)


def add_arguments_list(_parser: argparse.ArgumentParser) -> None:
    """Add nothing: there are no options."""


def run_list(_options: argparse.Namespace) -> int:
    """Print the names of all packages, those with built-in nodes included."""
    names = {*Workspace.discover().packages, *builtin_packages()}
    print("\n".join(sorted(names)))
    return 0


def add_arguments_prefix(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="Show share directory for the package")


def run_prefix(options: argparse.Namespace) -> int:
    """Print the prefix, the source folder of a package that is not installed."""
    package = _named_package(Workspace.discover(), options.package_name)
    if options.share:
        print(package.share)
        return 0
    print(package.prefix or package.path)
    if package.prefix is None and not package.is_builtin:
        text = f"'{package.name}' is not installed: this is its source folder"
        print(text, file=sys.stderr)
    return 0


def add_arguments_executables(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    parser.add_argument("package_name", nargs="?", help="The package name")
    parser.add_argument(
        "--full-path", action="store_true", help="Show full path of each executable"
    )


def run_executables(options: argparse.Namespace) -> int:
    """Print a line for each executable."""
    workspace = Workspace.discover()
    if options.package_name is None:
        names = {*workspace.packages, *builtin_packages()}
    else:
        names = {options.package_name}
        if not builtin_executables(options.package_name):
            _named_package(workspace, options.package_name)
    for name in sorted(names):
        package = workspace.packages.get(name)
        files = package.executable_names if package is not None else ()
        builtin = (
            () if package is not None and not package.is_builtin else builtin_executables(name)
        )
        if not options.full_path:
            for executable in sorted({*files, *builtin}):
                print(name, executable)
            continue
        for path in _paths(package, files):
            print(path)
        for executable in _not_compiled(package):
            text = f"{name} {executable} is C++, which is compiled when it is started"
            print(text, file=sys.stderr)
        for executable in sorted(set(builtin) - set(files)):
            print(f"{name} {executable} comes with Gazelle and is no file", file=sys.stderr)
    return 0


def add_arguments_xml(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("-t", "--tag", help="The XML tag to output (e.g. 'version')")


def run_xml(options: argparse.Namespace) -> int:
    """Print it.

    Raises:
        GazelleError: there is no such package, no manifest, or no such tag in it.
        UserFileError: the manifest cannot be read.
    """
    from gazelle.description.xml import read_xml

    package = _named_package(Workspace.discover(), options.package_name)
    file = package.path / "package.xml"
    if not file.is_file():
        raise GazelleError("Package XML manifest not found")
    diagnostics = Diagnostics()
    root = read_xml(file, diagnostics)
    if root is None:
        diagnostics.raise_if_errors()
        raise GazelleError("Package XML manifest not found")
    if options.tag is None:
        text = _COMMENT.sub("", file.read_text(encoding="utf-8", errors="replace"))
        print(text[max(0, text.find("<package")) :].rstrip())
        return 0
    found = root.find_all(options.tag)
    if not found:
        names = [tag.name for tag in root.children]
        raise GazelleError(f"XML tag not found{hint(options.tag, names)}")
    print("\n".join(tag.text for tag in found))
    return 0


def _named_package(workspace: Workspace, name: str) -> Package:
    """Return a package by its name.

    Raises:
        GazelleError: ``Package not found``, with names that are spelled alike.
    """
    if name not in workspace.packages:
        raise GazelleError(f"Package '{name}' not found{hint(name, workspace.packages)}")
    return workspace.packages[name]


def _paths(package: Package | None, names: tuple[str, ...]) -> list[str]:
    if package is None:
        return []
    found = [package.find_executables(name)[:1] for name in names]
    programs = (cpp_program(package, name) for name in names)
    made = [built_file(one) for one in programs if one is not None]
    paths = [path for paths in found for path in paths]
    return sorted(str(path) for path in (*paths, *made) if path is not None)


def _not_compiled(package: Package | None) -> list[str]:
    """Return the programs of a package's C++ that no build has made yet."""
    if package is None:
        return []
    programs = (cpp_program(package, name) for name in cpp_programs(package))
    return [one.executable for one in programs if one is not None and built_file(one) is None]
