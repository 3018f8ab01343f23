"""What the doctor says of healthy packages: public ones that people use, of both versions of ROS.

Run ``python benchmarks/doctor_precision/healthy.py --folder DIR`` from the repository.
`healthy.yaml` names repositories, commits and packages; what is not in the folder yet is fetched
by git. Each package is examined whole, in a process of its own, with all packages of its
workspace beside it. Findings count as a person reads them: those that say the same are one.

An error there is either a true fault of the package, which the table says with its reason, or a
false alarm, which is a defect of the doctor.
"""

from __future__ import annotations

import argparse
import fnmatch
import json
import os
import re
import statistics
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import yaml

_TABLE = Path(__file__).with_suffix(".yaml")
_SOURCE = "https://github.com/"
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
_ERROR, _WARNING = 30, 20


class Healthy(NamedTuple):
    """A package that is examined.

    Attributes:
        workspace: name of the workspace it lies in.
        path: from the workspace's ``src``.
    """

    workspace: str
    path: str


def main() -> None:
    """Examine the packages, print what counts and what nobody has judged yet."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, required=True, help="of the workspaces")
    parser.add_argument("--no-fetch", action="store_true", help="take only what lies there")
    parser.add_argument("--only", default="", help="packages with this in workspace and path")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--timeout", type=float, default=60.0, help="seconds a package")
    parser.add_argument("--kinds", action="store_true", help="count the codes of all findings")
    parser.add_argument("--out", type=Path, help="a line of JSON for each package")
    parser.add_argument("--examine", metavar="PATH", help=argparse.SUPPRESS)
    options = parser.parse_args()
    folder = options.folder.resolve()
    if options.examine:
        print(json.dumps(_examined(Path(options.examine))))
        return
    table = yaml.safe_load(_TABLE.read_text("utf-8"))
    if not options.no_fetch:
        _fetch(table["repositories"], folder)
    packages = [one for one in _packages(table, folder) if options.only in "/".join(one)]

    def examined(package: Healthy) -> dict[str, Any]:
        environ = table["workspaces"][package.workspace]
        return _in_process(package, folder, environ, options.timeout)

    results = []
    if options.out:
        options.out.write_text("", "utf-8")
    with ThreadPoolExecutor(options.jobs) as pool:
        for number, result in enumerate(pool.map(examined, packages), 1):
            results.append(result)
            if options.out:
                with options.out.open("a", encoding="utf-8") as stream:
                    stream.write(json.dumps(result) + "\n")
            print(f"\r{number} of {len(packages)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    _print(results, table["verdicts"] or (), kinds=options.kinds)


def _fetch(repositories: Sequence[Mapping[str, Any]], folder: Path) -> None:
    """Bring the commit of each repository that is not there."""
    for item in repositories:
        place = _place(item, folder)
        if place.exists():
            continue
        print(f"fetching {item['repository']}", file=sys.stderr)
        place.mkdir(parents=True)
        git = ("git", "-C", str(place))
        address = f"{_SOURCE}{item['repository']}"
        fetch = ("fetch", "--quiet", "--depth=1", "--filter=blob:none", address, item["commit"])
        subprocess.run([*git, "init", "--quiet"], check=True)
        # The folders' files are brought by the checkout, from here.
        subprocess.run([*git, "remote", "add", "origin", address], check=True)
        subprocess.run([*git, *fetch], check=True)
        wanted = [*item.get("folders", ["."]), *(f":!{one}" for one in item.get("dropped", ()))]
        subprocess.run([*git, "checkout", "--quiet", "FETCH_HEAD", "--", *wanted], check=True)


def _place(repository: Mapping[str, Any], folder: Path) -> Path:
    name = repository["repository"].rpartition("/")[2]
    return folder / repository["workspace"] / "src" / name


def _packages(table: Mapping[str, Any], folder: Path) -> list[Healthy]:
    found = []
    for item in table["repositories"]:
        place = _place(item, folder)
        source = folder / item["workspace"] / "src"
        for name in item["packages"]:
            if (place / name / "package.xml").is_file():
                path = (place / name).relative_to(source).as_posix()
                found.append(Healthy(item["workspace"], path))
            else:
                print(f"not there: {place / name}", file=sys.stderr)
    return found


def _in_process(
    package: Healthy, folder: Path, environ: Mapping[str, Any], timeout: float
) -> dict[str, Any]:
    """Examine a package in a process of its own, which may crash or hang."""
    source = folder / package.workspace / "src"
    base = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
    around = {name: str(value) for name, value in environ.items()}
    # Commands of launch files, such as xacro, are those beside this Python.
    around["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), base.get("PATH", "")])
    command = [sys.executable, __file__, "--folder", str(folder)]
    command += ["--examine", str(source / package.path)]
    result: dict[str, Any] = {**package._asdict(), "findings": [], "seconds": timeout}
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=timeout, check=True,
            env={**base, **around, "ROS_PACKAGE_PATH": str(source)},
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return {**result, "findings": [_failure("HANG", f"more than {timeout:g} s", package)]}
    except subprocess.CalledProcessError as error:
        last = (error.stderr.strip().splitlines() or [""])[-1]
        return {**result, "findings": [_failure("CRASH", last, package)]}
    seconds, findings = json.loads(done.stdout.splitlines()[-1])
    text = json.dumps(findings).replace(f"{source}/", "")
    return {**result, "findings": json.loads(text), "seconds": seconds}


def _failure(code: str, message: str, package: Healthy) -> dict[str, Any]:
    return {"code": code, "severity": _ERROR, "message": message, "file": package.path, "line": 0}


def _examined(folder: Path) -> tuple[float, list[dict[str, Any]]]:
    from gazelle.diagnostics import grouped
    from gazelle.doctor import Options, examine

    began = time.process_time()
    report = examine([f"{folder}/"], options=Options(environ=dict(os.environ)), cwd=folder)
    seconds = time.process_time() - began
    return seconds, [
        {
            "code": item.code,
            "severity": int(item.severity),
            "message": item.message,
            "file": item.span.file if item.span else "",
            "line": item.span.line if item.span else 0,
            "fix": item.fix,
        }
        for item in grouped(report.findings)
    ]


def _verdict(finding: Mapping[str, Any], verdicts: Sequence[Mapping[str, str]]) -> str:
    """Return what the table says of a finding, an empty text when nothing."""
    message = _NUMBER.sub("#", finding["message"])
    for item in verdicts:
        # Of several workspaces that hold a repository, each has the fault.
        if (
            finding["code"] == item["code"]
            and fnmatch.fnmatchcase(finding["file"], item["file"])
            and item.get("message", "") in message
        ):
            return item["verdict"]
    return ""


def _print(
    results: Sequence[Mapping[str, Any]], verdicts: Sequence[Mapping[str, str]], *, kinds: bool
) -> None:
    errors = [one for item in results for one in item["findings"] if one["severity"] >= _ERROR]
    judged = [one for one in errors if _verdict(one, verdicts).startswith("true fault")]
    false = [one for one in errors if _verdict(one, verdicts).startswith("false alarm")]
    open_ones = [one for one in errors if not _verdict(one, verdicts)]
    warnings = [_count(item, _WARNING) for item in results]
    if kinds:
        _print_kinds(results)
    for title, some in (("unjudged", open_ones), ("false alarm", false)):
        for one in some:
            print(f"{title}: {one['file']}:{one['line']}: {one['message']} [{one['code']}]")
    slowest = max(results, key=lambda item: item["seconds"])
    clean = sum(not _count(item, _ERROR) for item in results)
    print(f"packages          {len(results)}, {clean} of them without an error")
    print(f"errors            {len(errors)}")
    print(f"  true faults     {len(judged)}")
    print(f"  false alarms    {len(false)}")
    print(f"  unjudged        {len(open_ones)}")
    print(f"warnings, median  {statistics.median(warnings):g} a package, {max(warnings)} at most")
    print(f"slowest           {slowest['seconds']:.1f} s of CPU, {slowest['path']}")


def _print_kinds(results: Sequence[Mapping[str, Any]]) -> None:
    """Count each code: in how many packages, and how often in all."""
    places: Counter[tuple[int, str]] = Counter()
    times: Counter[tuple[int, str]] = Counter()
    for item in results:
        found = Counter((one["severity"], one["code"]) for one in item["findings"])
        places.update(found.keys())
        times.update(found)
    for kind, count in sorted(places.items(), key=lambda one: (-one[0][0], -one[1])):
        print(f"{kind[0]} {kind[1]:40} in {count} packages, {times[kind]} times")


def _count(result: Mapping[str, Any], severity: int) -> int:
    return sum(one["severity"] == severity for one in result["findings"])


if __name__ == "__main__":
    main()
