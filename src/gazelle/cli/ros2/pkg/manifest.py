"""``ros2 pkg xml``: a package's manifest, or one of its tags."""

from __future__ import annotations

import argparse
import re

from gazelle.cli.ros2.pkg.listing import named_package
from gazelle.cli.tool import hint
from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.workspace import Workspace

__all__ = ["add_arguments", "run"]

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("-t", "--tag", help="The XML tag to output (e.g. 'version')")


def run(options: argparse.Namespace) -> int:
    """Print it.

    Raises:
        GazelleError: there is no such package, no manifest, or no such tag in it.
        UserFileError: the manifest cannot be read.
    """
    package = named_package(Workspace.discover(), options.package_name)
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
