"""``ros2 launch [options] PACKAGE FILE [name:=value …]``, or a path in place of both."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle.cli.ros2.verbs import guarded
from gazelle.cli.ros_tool import ToolError
from gazelle.cpp.lookup import CPP_VARIABLE
from gazelle.diagnostics import Severity, did_you_mean, render
from gazelle.launch.environment import drop_in_folder, node_environment
from gazelle.process_lifetime import when_nobody_reads
from gazelle.workspace.ament_index import (
    PackageNotFoundError,
    get_package_share_directory,
    known_workspace,
)

__all__ = [
    "launch_arguments",
    "main",
    "prepare_launch_environment",
    "ros2_environment",
]

_DISTRO = "humble"
_ROS1_DISTROS = frozenset({"", "noetic", "melodic", "kinetic", "indigo", "jade", "lunar", "hydro"})
_ENDINGS = ("launch.py", ".launch", "launch.xml", "launch.yaml", "launch.yml")
_PRUNED = frozenset({"__pycache__", "build", "install", "log", "node_modules"})
_ASSIGN = ":="


def main(argv: list[str]) -> int:
    """Run launch files of ROS 2: Python, XML and YAML."""
    # Arguments may stand before options, and look like neither.
    tokens = [word for word in argv if _ASSIGN not in word]
    given = [word for word in argv if _ASSIGN in word]
    return guarded(lambda: _run(_parser().parse_args(tokens), given))


def ros2_environment(environ: Mapping[str, str]) -> dict[str, str]:
    """Return an environment in which ROS's commands and modules are Gazelle's, as ROS 2 has it.

    Some launch files choose files by ``ROS_DISTRO``; without a ROS 2 it is one that most know.
    """
    given = dict(environ)
    if given.get("ROS_DISTRO", "") in _ROS1_DISTROS:
        given["ROS_DISTRO"] = _DISTRO
    given["ROS_VERSION"] = "2"
    given.setdefault("ROS_PYTHON_VERSION", "3")
    return node_environment(given, known_workspace())


def prepare_launch_environment() -> None:
    """Let this process, in which launch files are run, have that environment and the modules."""
    from gazelle.compat.import_hooks import install

    os.environ.update(ros2_environment(os.environ))
    folder = str(drop_in_folder())
    if folder not in sys.path:
        sys.path.insert(1, folder)
    install()


def launch_arguments(argv: Sequence[str]) -> list[tuple[str, str]]:
    """Return the arguments of a command line; of several with one name the last counts.

    Raises:
        ToolError: one is not ``name:=value``.
    """
    found: dict[str, str] = {}
    for word in argv:
        name, sign, value = word.partition(_ASSIGN)
        if not sign or not name or (not value and word.count(_ASSIGN) == 1):
            raise ToolError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'"
                f"{_argument_hint(word)}"
            )
        found[name] = value
    return list(found.items())


def _is_launch_file(name: str) -> bool:
    """Tell whether a file's name is one of launch files."""
    return name.endswith(_ENDINGS)


def _launch_files_below(folder: str) -> list[Path]:
    """Return the launch files in a folder and below."""
    return [path for path in _files_below(folder) if _is_launch_file(path.name)]


def _launch_file_of(package: str, name: str) -> Path:
    """Return the file of a name anywhere in a package.

    Raises:
        PackageNotFoundError: there is no such package.
        ValueError: the package's name is not legal.
        ToolError: there is no such file, or more than one.
    """
    share = get_package_share_directory(package)
    # A file that is there at two places is one file.
    places: dict[Path, Path] = {}
    for path in _files_below(share):
        if path.name == name:
            places.setdefault(path.resolve(), path)
    found = list(places.values())
    if len(found) == 1:
        return found[0]
    if found:
        listed = ", ".join(f"'{path}'" for path in found)
        raise ToolError(
            f"file '{name}' was found more than once in the share directory of package "
            f"'{package}': [{listed}]\n  fix: ros2 launch {found[0]}"
        )
    raise ToolError(
        f"file '{name}' was not found in the share directory of package '{package}' which is at "
        f"'{share}'{_instead(share, package, name)}"
    )


def _instead(share: str, package: str, name: str) -> str:
    direct = Path(share) / name
    if direct.is_file():
        # ROS 2 takes a bare name only.
        return f"\n  fix: ros2 launch {package} {direct.name}"
    names = sorted({path.name for path in _launch_files_below(share)})
    found = known_workspace().packages.get(package)
    note = f"\n  {found.note_on_files}" if found is not None and found.note_on_files else ""
    if not names:
        return f"\n  package '{package}' has no launch files{note}"
    near = did_you_mean(name, names)
    return f"\n  {near}" if near else f"\n  it has: {', '.join(names)}{note}"


def _files_below(folder: str) -> list[Path]:
    files: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(
            one for one in folders if one not in _PRUNED and not one.startswith(".")
        )
        files += [Path(root, one) for one in sorted(names)]
    return files


def _argument_hint(word: str) -> str:
    name, sign, value = word.partition("=")
    if sign and not word.endswith(_ASSIGN):
        return f"\n  fix: {name.rstrip(':')}:={value}"
    return "\n  fix: name:='' is not possible; write name:=\"''\" for an empty value"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="ros2 launch", description="Run a launch file")
    add = parser.add_argument
    text = "Run the launch system non-interactively, with no terminal associated"
    interactive = sys.stdin is not None and sys.stdin.isatty()
    add("-n", "--noninteractive", default=not interactive, action="store_true", help=text)
    text = "Put the launch system in debug mode, provides more verbose output."
    add("-d", "--debug", action="store_true", help=text)
    group = parser.add_mutually_exclusive_group()
    text = "Print the launch description to the console without launching it."
    group.add_argument("-p", "--print", "--print-description", action="store_true", help=text)
    text = "Show arguments that may be given to the launch file."
    group.add_argument("-s", "--show-args", "--show-arguments", action="store_true", help=text)
    text = "Show all launched subprocesses' output by overriding their output configuration"
    text += " using the OVERRIDE_LAUNCH_PROCESS_OUTPUT envvar."
    add("-a", "--show-all-subprocesses-output", action="store_true", help=text)
    text = "Prefix command, which should go before all executables. Command must be wrapped in"
    text += " quotes if it contains spaces (e.g. --launch-prefix 'xterm -e gdb -ex run --args')."
    add("--launch-prefix", help=text)
    text = "Regex pattern for filtering which executables the --launch-prefix is applied to by"
    add("--launch-prefix-filter", help=f"{text} matching the executable name.")
    text = "Take the C++ of packages where Gazelle has nodes of the same names"
    add("--cpp", action="store_true", help=text)
    add("package_name", help="Name of the ROS package which contains the launch file")
    add("launch_file_name", nargs="?", help="Name of the launch file")
    text = "Arguments to the launch file; '<name>:=<value>' (for duplicates, last one wins)"
    add("launch_arguments", nargs="*", help=text)
    return parser


def _run(options: argparse.Namespace, given: list[str]) -> int:
    if options.launch_prefix is None and options.launch_prefix_filter is not None:
        raise ToolError("--launch-prefix must be specified if --launch-prefix-filter is provided")
    path, misplaced = _file_and_rest(options)
    tokens = [*misplaced, *given]
    for name in ("launch_prefix", "launch_prefix_filter"):
        value = getattr(options, name)
        if value:
            tokens.append(f"{name.replace('_', '-')}{_ASSIGN}{value}")
    arguments = launch_arguments(tokens)
    if options.cpp:
        os.environ[CPP_VARIABLE] = "1"
    if options.show_all_subprocesses_output:
        os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "both"
    prepare_launch_environment()
    if options.print or options.show_args:
        return _show(path, with_arguments=options.show_args)
    return _launch(path, arguments, tokens, options)


def _file_and_rest(options: argparse.Namespace) -> tuple[Path, list[str]]:
    """Return the launch file and the words that stand where arguments do."""
    first, second = options.package_name, options.launch_file_name
    if Path(first).is_file():
        return Path(first), [*([second] if second else ()), *options.launch_arguments]
    if second is None:
        raise ToolError(_no_file(first))
    try:
        return _launch_file_of(first, second), options.launch_arguments
    except PackageNotFoundError as error:
        raise ToolError(f"Package '{first}' not found: {error}") from None
    except ValueError as error:
        raise ToolError(str(error)) from None


def _no_file(first: str) -> str:
    if "/" in first or first.endswith((".py", ".xml", ".yaml")):
        names = sorted(str(one) for one in Path(first).parent.glob("*launch*"))
        hint = did_you_mean(first, names)
        return f"file '{first}' does not exist" + (f"; {hint}" if hint else "")
    if first not in known_workspace().packages:
        hint = did_you_mean(first, known_workspace().packages)
        return f"'{first}' is neither a launch file nor a package" + (f"; {hint}" if hint else "")
    folder = known_workspace().packages[first].path
    names = sorted({one.name for one in _launch_files_below(str(folder))})
    known = f"package '{first}' has: {', '.join(names)}" if names else "it has no launch files"
    return f"No launch file name supplied; {known}"


def _show(path: Path, *, with_arguments: bool) -> int:
    """Print the tree of a launch file, or its arguments."""
    from gazelle.launch.ros2.error_diagnostics import diagnose
    from gazelle.launch.ros2.launch_description import argument_lines
    from gazelle.launch.ros2.launch_description_sources import (
        get_launch_description_from_any_launch_file,
    )
    from gazelle.launch.ros2.launch_introspector import LaunchIntrospector

    try:
        description = get_launch_description_from_any_launch_file(str(path))
        if with_arguments:
            print("\n".join(argument_lines(description)))
        else:
            print(LaunchIntrospector().format_launch_description(description))
    except Exception as error:  # noqa: BLE001 - a launch file may raise anything
        render(diagnose(error))
        return 1
    return 0


def _launch(
    path: Path,
    arguments: list[tuple[str, str]],
    argv: list[str],
    options: argparse.Namespace,
) -> int:
    from gazelle.launch.ros2 import LaunchDescription, LaunchService
    from gazelle.launch.ros2.actions import IncludeLaunchDescription
    from gazelle.launch.ros2.events import Shutdown
    from gazelle.launch.ros2.launch_description_sources import AnyLaunchDescriptionSource

    service = LaunchService(argv=argv, noninteractive=options.noninteractive, debug=options.debug)
    source = AnyLaunchDescriptionSource(str(path))
    included = IncludeLaunchDescription(source, launch_arguments=arguments)
    service.include_launch_description(LaunchDescription([included]))
    unread = Shutdown(reason="nobody reads the output any more")
    when_nobody_reads(sys.stdout, lambda: service.emit_event(unread))
    code = service.run()
    # A node that could not be started is told when it is its turn, and the others go on.
    failed = any(one.severity >= Severity.ERROR for one in service.context.diagnostics)
    return code or int(failed)
