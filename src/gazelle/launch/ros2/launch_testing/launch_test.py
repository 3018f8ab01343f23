"""The ``launch_test`` command."""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from gazelle.documents.files import is_file
from gazelle.launch.environment import drop_in_folder
from gazelle.launch.ros2.launch_description import argument_lines
from gazelle.launch.ros2.launch_testing.loader import LoadTestsFromPythonModule
from gazelle.launch.ros2.launch_testing.test_result import unittestResultsToXml
from gazelle.launch.ros2.launch_testing.test_runner import LaunchTestRunner
from gazelle.launch.ros2.user_spans import raising_span

__all__ = ["add_arguments", "main", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's options to a parser."""
    parser.add_argument("launch_test_file", help="path of the launch test")
    parser.add_argument("--package-name", help="package of the test, for the report")
    parser.add_argument("-v", "--verbose", action="store_true", help="log everything")
    parser.add_argument(
        "-s",
        "--show-args",
        "--show-arguments",
        action="store_true",
        help="print the arguments that the launch takes",
    )
    parser.add_argument("launch_arguments", nargs="*", help="<name>:=<value>")
    parser.add_argument("--junit-xml", dest="xmlpath", help="write a report to this path")


def run(
    parser: argparse.ArgumentParser,
    args: argparse.Namespace,
    test_runner_cls: type[LaunchTestRunner] = LaunchTestRunner,
) -> int:
    """Run the tests of a file and return 0 when all passed, else 1."""
    file = Path(args.launch_test_file).absolute()
    if not is_file(file):
        parser.error(f"Test file '{args.launch_test_file}' does not exist")
    package = args.package_name or file.stem
    module = _module(package, file)
    if not hasattr(module, "generate_test_description"):
        parser.error(f"Test file '{file}' is missing generate_test_description function")
    runs = LoadTestsFromPythonModule(module, name=f"{package}.{file.stem}.launch_tests")
    runner = test_runner_cls(runs, args.launch_arguments, args.verbose)
    runner.validate()
    if args.show_args:
        text = "\n".join(argument_lines(runs[0].get_launch_description()))
        sys.stdout.write(f"{text}\n")
        return 0
    results = runner.run()
    if args.xmlpath:
        report = unittestResultsToXml(test_results=results, name=f"{package}.{file.stem}")
        report.write(args.xmlpath, encoding="utf-8", xml_declaration=True)
    return 0 if all(one.wasSuccessful() for one in results.values()) else 1


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    parser = argparse.ArgumentParser(
        prog="launch_test", description="Launch integration testing tool."
    )
    add_arguments(parser)
    args = parser.parse_args(argv)
    try:
        return run(parser, args)
    except Exception as error:  # noqa: BLE001 - a test file may raise anything when it is loaded
        span = raising_span(error)
        parser.error(f"{span.file}:{span.line}: {error}" if span else str(error))


def _module(name: str, file: Path) -> ModuleType:
    folder = str(drop_in_folder())
    if folder not in sys.path:
        sys.path.append(folder)
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    # Where unittest and pickle look a class of the file up.
    sys.modules.setdefault(name, module)
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    sys.exit(main())
