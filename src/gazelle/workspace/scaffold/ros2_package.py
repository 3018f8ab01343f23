"""Packages as ``ros2 pkg create`` makes them: which files, with what in them."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

from gazelle.workspace.scaffold.cpp_package import (
    ament_lists,
    cmake_config,
    cmake_lists,
    library_header,
    library_source,
    node_source,
    visibility_header,
)
from gazelle.workspace.scaffold.create_package import PackageWriter

__all__ = ["BUILD_TYPES", "Ros2Package", "write_ros2_package"]

BUILD_TYPES = ("cmake", "ament_cmake", "ament_python")
"""What ``--build-type`` may be."""

_TESTS = {
    "ament_cmake": ("ament_lint_auto", "ament_lint_common"),
    "ament_python": ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest"),
}
_SCHEMA = "http://download.ros.org/schema/package_format{0}.xsd"
_SETUP = """from setuptools import find_packages, setup

package_name = {name!r}

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer={maintainer!r},
    maintainer_email={email!r},
    description={description!r},
    license={license!r},
    tests_require=['pytest'],
    entry_points={{
        'console_scripts': [
{scripts}        ],
    }},
)
"""
_CFG = """[develop]
script_dir=$base/lib/{0}
[install]
install_scripts=$base/lib/{0}
"""
_NODE = """def main():
    print('Hi from {0}.')


if __name__ == '__main__':
    main()
"""
_LINTER = '''"""Runs {tool} over the package; skipped where that is not installed."""

import pytest


@pytest.mark.{mark}
@pytest.mark.linter
def test_{mark}():
    tool = pytest.importorskip('{tool}.main')
    assert tool.main(argv=['.', 'test']) == 0, '{tool} found something to mend'
'''


@dataclass(frozen=True, slots=True)
class Ros2Package:
    """What is asked for.

    Attributes:
        name: of the package.
        build_type: one of `BUILD_TYPES`.
        depends: written as ``<depend>``.
        node: name of an executable, empty for none.
        library: name of a library, empty for none.
        description: one line.
        license: as written.
        maintainer: name.
        email: address of the maintainer.
        format: of the manifest, 2 or 3.
    """

    name: str
    build_type: str = "ament_cmake"
    depends: tuple[str, ...] = ()
    node: str = ""
    library: str = ""
    description: str = "TODO: Package description"
    license: str = "TODO: License declaration"
    maintainer: str = "maintainer"
    email: str = "maintainer@todo.todo"
    format: int = 3


def write_ros2_package(package: Ros2Package, parent: str, say: Callable[[str], None]) -> Path:
    """Write the package into a folder of its name.

    Args:
        package: what to write.
        parent: the folder it is made in, as it is to be printed.
        say: told each folder and file.

    Returns:
        The package's folder.

    Raises:
        ScaffoldError: something cannot be written.
    """
    writer = PackageWriter(say, "creating folder", "creating")
    folder = writer.folder(os.path.join(parent, package.name))  # noqa: PTH118 - keeps './' as printed
    base = os.path.join(parent, package.name)  # noqa: PTH118
    writer.file(f"{base}/package.xml", _manifest(package))
    if package.build_type == "ament_python":
        _write_python(package, base, writer)
    else:
        _write_cmake(package, base, writer)
    return folder


def _write_python(package: Ros2Package, base: str, writer: PackageWriter) -> None:
    writer.say("creating source folder")
    source = f"{base}/{package.name}"
    writer.folder(source)
    row = f"            '{package.node} = {package.name}.{package.node}:main'\n"
    setup = _SETUP.format(
        name=package.name, maintainer=package.maintainer, email=package.email,
        description=package.description, license=package.license,
        scripts=row if package.node else "",
    )  # fmt: skip
    writer.file(f"{base}/setup.py", setup)
    writer.file(f"{base}/setup.cfg", _CFG.format(package.name))
    writer.folder(f"{base}/resource")
    writer.file(f"{base}/resource/{package.name}", "")
    writer.file(f"{source}/__init__.py", "")
    writer.folder(f"{base}/test")
    for mark in ("copyright", "flake8", "pep257"):
        writer.file(f"{base}/test/test_{mark}.py", _LINTER.format(tool=f"ament_{mark}", mark=mark))
    if package.node:
        writer.file(f"{source}/{package.node}.py", _NODE.format(package.name))
    if package.library:
        writer.folder(f"{source}/{package.library}")
        writer.file(f"{source}/{package.library}/__init__.py", "")


def _write_cmake(package: Ros2Package, base: str, writer: PackageWriter) -> None:
    name, node, library = package.name, package.node, package.library
    writer.say("creating source and include folder")
    writer.folder(f"{base}/src")
    include = f"{base}/include/{name}"
    writer.folder(include)
    if package.build_type == "ament_cmake":
        writer.file(f"{base}/CMakeLists.txt", ament_lists(name, package.depends, node, library))
    else:
        writer.file(f"{base}/CMakeLists.txt", cmake_lists(name, package.depends, node, library))
        for suffix, text in cmake_config(name, library).items():
            writer.file(f"{base}/{name}{suffix}", text)
    if node:
        writer.file(f"{base}/src/{node}.cpp", node_source(name))
    if library:
        writer.file(f"{include}/{library}.hpp", library_header(name, library))
        writer.file(f"{base}/src/{library}.cpp", library_source(name, library))
        writer.file(f"{include}/visibility_control.h", visibility_header(name))


def _manifest(package: Ros2Package) -> str:
    schema = _SCHEMA.format(package.format)
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="{schema}" schematypens="http://www.w3.org/2001/XMLSchema"?>',
        f'<package format="{package.format}">',
        f"  <name>{escape(package.name)}</name>",
        "  <version>0.0.0</version>",
        f"  <description>{escape(package.description)}</description>",
        f'  <maintainer email="{escape(package.email, {chr(34): "&quot;"})}">'
        f"{escape(package.maintainer)}</maintainer>",
        f"  <license>{escape(package.license)}</license>",
        "",
    ]
    tool = "ament_cmake_ros" if package.library else "ament_cmake"
    blocks = (
        ("buildtool_depend", (tool,) if package.build_type == "ament_cmake" else ()),
        ("depend", package.depends),
        ("test_depend", _TESTS.get(package.build_type, ())),
    )
    for tag, names in blocks:
        lines += [f"  <{tag}>{escape(name)}</{tag}>" for name in names]
        lines += [""] if names else []
    lines += ["  <export>", f"    <build_type>{package.build_type}</build_type>", "  </export>"]
    return "\n".join([*lines, "</package>", ""])
