"""The official xacro library in a plain process of its own, for comparison.

As a module of the tests it starts that process; as a script it is that process.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

__all__ = ["Outcome", "run_official"]


class Outcome(NamedTuple):
    """What a run of the program gave: exit code, standard output, standard error."""

    code: int
    out: str
    err: str


def run_official(
    calls: Sequence[Sequence[str]], folder: Path, packages: Mapping[str, str] | None = None
) -> list[Outcome]:
    """Run ``xacro WORDS…`` once for each call, in a folder, with packages for ``$(find)``."""
    # The script finds no package of the tests.
    from tests.patience import stretched

    environ = {**os.environ, "PYTHONPATH": "", "PYTHONUTF8": "1"}
    task = json.dumps({"calls": [list(words) for words in calls], "packages": packages or {}})
    done = subprocess.run(
        [sys.executable, __file__], input=task, capture_output=True, text=True, check=True,
        cwd=folder, env=environ, timeout=stretched(120),
    )  # fmt: skip
    return [Outcome(*item) for item in json.loads(done.stdout)]


def _main() -> None:
    task = json.load(sys.stdin)
    _provide_packages(task["packages"])
    json.dump([_run(words) for words in task["calls"]], sys.stdout)


def _provide_packages(packages: dict[str, str]) -> None:
    """Stand in for ament_index_python, of which the library needs one function."""
    module: Any = ModuleType("ament_index_python.packages")
    module.get_package_share_directory = packages.__getitem__
    sys.modules["ament_index_python"] = ModuleType("ament_index_python")
    sys.modules["ament_index_python.packages"] = module


def _run(words: list[str]) -> tuple[int, str, str]:
    # The library names this module without importing it: a missing file would be a traceback.
    import xml.parsers.expat

    import xacro

    assert xml.parsers.expat
    xacro.all_includes = []
    xacro.root_dir = os.curdir
    xacro.substitution_args_context = {}
    sys.argv = ["xacro", *words]
    out, err, code = io.StringIO(), io.StringIO(), 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            xacro.main()
        except SystemExit as stop:
            code = stop.code if isinstance(stop.code, int) else 1
        # A traceback is what the program ends with then.
        except Exception:  # noqa: BLE001
            code = 1
    return code, out.getvalue(), err.getvalue()


if __name__ == "__main__":
    # The folder of this script would be the first place to look for modules.
    del sys.path[0]
    _main()
