"""Packages as ``catkin_create_pkg`` makes them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

from gazelle.workspace.scaffold.create_package import PackageWriter, ScaffoldError

__all__ = ["CatkinPackage", "write_catkin_package"]

_LISTS = """cmake_minimum_required(VERSION 3.0.2)
project({name})

## Packages that this one needs
{find}
{system}
## Python modules: uncomment this when the package has a setup.py
# catkin_python_setup()

## Messages, services and actions: list the files of the folders msg, srv and action, and name
## message_generation (build_depend) and message_runtime (exec_depend) in package.xml
# add_message_files(FILES Message1.msg)
# add_service_files(FILES Service1.srv)
# add_action_files(FILES Action1.action)
# generate_messages(DEPENDENCIES {messages})

## Live parameters: the files of the folder cfg
# generate_dynamic_reconfigure_options(cfg/Parameters.cfg)

## What packages that depend on this one get from it
catkin_package(
#  INCLUDE_DIRS include
#  LIBRARIES {name}
#  CATKIN_DEPENDS {depends}
#  DEPENDS system_lib
)

## C++
include_directories(
# include
{includes})
# add_library(${{PROJECT_NAME}} src/${{PROJECT_NAME}}/{name}.cpp)
# add_executable(${{PROJECT_NAME}}_node src/{name}_node.cpp)
# target_link_libraries(${{PROJECT_NAME}}_node ${{catkin_LIBRARIES}})

## Scripts, launch files and other data
# catkin_install_python(PROGRAMS scripts/my_script.py
#   DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}}
# )
# install(DIRECTORY launch
#   DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}}
# )

## Tests
# catkin_add_gtest(${{PROJECT_NAME}}-test test/test_{name}.cpp)
# catkin_add_nosetests(test)
"""
_META_LISTS = """cmake_minimum_required(VERSION 3.0.2)
project({0})
find_package(catkin REQUIRED)
catkin_metapackage()
"""


@dataclass(frozen=True, slots=True)
class CatkinPackage:
    """What is asked for.

    Attributes:
        name: of the package.
        depends: catkin packages.
        system: packages found with CMake.
        boost: components of Boost.
        version: three numbers.
        description: empty for one made of the name.
        licenses: at least one is written.
        authors: names.
        maintainers: names, each with an address in angle brackets or without.
        is_meta: a metapackage.
    """

    name: str
    depends: tuple[str, ...] = ()
    system: tuple[str, ...] = ()
    boost: tuple[str, ...] = ()
    version: str = "0.0.0"
    description: str = ""
    licenses: tuple[str, ...] = ()
    authors: tuple[str, ...] = ()
    maintainers: tuple[str, ...] = ()
    is_meta: bool = False


def write_catkin_package(package: CatkinPackage, parent: Path, say: Callable[[str], None]) -> Path:
    """Write the package into a folder of its name below `parent`.

    Returns:
        The package's folder.

    Raises:
        ScaffoldError: a file is there already, or cannot be written.
    """
    folder = parent / package.name
    for name in ("package.xml", "CMakeLists.txt"):
        if (folder / name).exists():
            raise ScaffoldError(f"File exists: {folder / name}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ScaffoldError(f"cannot make {folder}: {error.strerror}") from error
    # The lines name paths relative to the parent, as the original's do.
    writer = PackageWriter(lambda _line: None, "", "")
    for name, text in (("package.xml", _manifest(package)), ("CMakeLists.txt", _lists(package))):
        writer.file(folder / name, text)
        say(f"Created file {package.name}/{name}")
    for name in _folders(package):
        writer.folder(folder / name)
        say(f"Created folder {package.name}/{name}")
    return folder


def _folders(package: CatkinPackage) -> Sequence[str]:
    has_cpp = "roscpp" in package.depends
    include = [f"include/{package.name}"] if has_cpp else []
    return [*include, "src"] if has_cpp or "rospy" in package.depends else include


def _lists(package: CatkinPackage) -> str:
    if package.is_meta:
        return _META_LISTS.format(package.name)
    depends = sorted(package.depends)
    find = "find_package(catkin REQUIRED)"
    if depends:
        names = "".join(f"  {name}\n" for name in depends)
        find = f"find_package(catkin REQUIRED COMPONENTS\n{names})"
    system = [f"find_package({name} REQUIRED)" for name in package.system]
    if package.boost:
        parts = " ".join(sorted(package.boost))
        system.insert(0, f"find_package(Boost REQUIRED COMPONENTS {parts})")
    found = [*(["catkin"] if depends else []), *(["Boost"] if package.boost else [])]
    includes = [f"  ${{{name}_INCLUDE_DIRS}}\n" for name in (*found, *package.system)]
    messages = [name for name in depends if name.endswith("_msgs")]
    return _LISTS.format(
        name=package.name, find=find, system="".join(f"{line}\n" for line in system),
        messages=" ".join(messages or ["std_msgs"]), depends=" ".join(depends or ["other_package"]),
        includes="".join(includes),
    )  # fmt: skip


def _manifest(package: CatkinPackage) -> str:
    description = package.description or f"The {package.name} package"
    lines = [
        '<?xml version="1.0"?>',
        '<package format="2">',
        f"  <name>{escape(package.name)}</name>",
        f"  <version>{escape(package.version)}</version>",
        f"  <description>{escape(description)}</description>",
        "",
        "  <!-- Who answers for the package; one tag for each person -->",
        *(f"  {_person('maintainer', who)}" for who in package.maintainers),
        "",
        "  <!-- Such as BSD, MIT, Apache-2.0, GPLv3; one tag for each license -->",
        *(f"  <license>{escape(name)}</license>" for name in package.licenses or ("TODO",)),
        "",
    ]
    if package.authors:
        lines += [*(f"  {_person('author', who)}" for who in package.authors), ""]
    lines += ["  <!-- depend is build_depend, build_export_depend and exec_depend in one -->"]
    lines += ["  <buildtool_depend>catkin</buildtool_depend>"]
    names = sorted({*package.depends, *package.system, *(["boost"] if package.boost else [])})
    tags = ("exec_depend",) if package.is_meta else (
        "build_depend", "build_export_depend", "exec_depend")  # fmt: skip
    lines += [f"  <{tag}>{escape(name)}</{tag}>" for tag in tags for name in names]
    inside = "    <metapackage/>" if package.is_meta else "    <!-- what other tools ask for -->"
    return "\n".join([*lines, "", "  <export>", inside, "  </export>", "</package>", ""])


def _person(tag: str, who: str) -> str:
    name, _, rest = who.partition("<")
    address = rest.rstrip("> ")
    name = name.strip()
    if tag == "maintainer" and not address:
        address = f"{name.replace(' ', '.')}@todo.todo"
    email = f' email="{escape(address, {chr(34): "&quot;"})}"' if address else ""
    return f"<{tag}{email}>{escape(name)}</{tag}>"
