"""``rostest [PACKAGE] FILE.test [arg:=value …]``: runs the ``<test>`` nodes of a launch file."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from gazelle.cli.rostest.results import Case, print_summary, write_suite
from gazelle.cli.rostest.running import TestRun
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError
from gazelle.folders import ros_home
from gazelle.launch.config import LaunchConfig
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.workspace import Workspace

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run the tests.

    Returns:
        0 when all passed, 1 when one did not, 2 for wrong usage.
    """
    try:
        options = _parser().parse_args([word for word in argv if not _is_arg(word)])
    except SystemExit as stop:
        return int(stop.code or 0)
    workspace, diagnostics = Workspace.discover(), Diagnostics()
    file = _file(options.target, workspace)
    args = dict(word.split(":=", 1) for word in argv if _is_arg(word))
    config = load_launch_files([file], args, workspace=workspace, diagnostics=diagnostics)
    diagnostics.raise_if_errors()
    package = options.pkgdir or _package_of(file, workspace)
    if not config.tests:
        print(f"rostest: '{file}' has no <test>; roslaunch runs it")
        return 1
    folder = Path(options.results_base_dir or ros_home(os.environ) / "test_results") / package
    cases = _run(config, file, args, folder=folder, workspace=workspace, text=options.text)
    name = options.results_filename or f"rostest-{file.stem}.xml"
    print(f"[ROSTEST] Outputting test results to {folder / name}")
    write_suite(folder / name, f"rostest.{file.stem}", cases)
    return print_summary(package, cases)


def _run(
    config: LaunchConfig,
    file: Path,
    args: dict[str, str],
    *,
    folder: Path,
    workspace: Workspace,
    text: bool,
) -> list[Case]:
    cases: list[Case] = []
    for test in config.tests:
        result = folder / f"rosunit-{test.test_name}.xml"
        with TestRun(file, args, has_nodes=bool(config.nodes), workspace=workspace) as run:
            run.set_parameters(config)
            found = run.tried(test, result, show=text)
        cases += found
        state = "ok" if all(one.passed for one in found) else "FAILURE!"
        print(f"[Testcase: test{test.test_name}] ... {state}", flush=True)
    return cases


def _is_arg(word: str) -> bool:
    return ":=" in word and not word.startswith("-")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rostest", usage="rostest [options] [package] <filename> [arg_name:=value...]"
    )
    add = parser.add_argument
    add("target", nargs="+", help=argparse.SUPPRESS)
    add("-t", "--text", action="store_true", help="output of the tests to the terminal")
    add("--pkgdir", metavar="NAME", help="package that the results belong to")
    add("--results-filename", metavar="NAME", help="results_filename")
    add("--results-base-dir", metavar="DIR", help="the folder of all results")
    return parser


def _file(target: list[str], workspace: Workspace) -> Path:
    if len(target) == 1 and Path(target[0]).is_file():
        return Path(target[0]).resolve()
    if len(target) != 2:
        raise NotFoundError("test file", target[0], searched=[str(Path.cwd())])
    package = workspace.package(target[0])
    found = sorted(package.path.rglob(target[1]))
    if not found:
        names = sorted({path.name for path in package.path.rglob("*.test")})
        hint = f"test files there: {', '.join(names) or 'none'}"
        raise NotFoundError("test file", target[1], searched=[str(package.path)], hint=hint)
    return found[0]


def _package_of(file: Path, workspace: Workspace) -> str:
    roots = {item.path.resolve(): item.name for item in workspace.packages.values()}
    return next((roots[one] for one in file.parents if one in roots), "no_package")
