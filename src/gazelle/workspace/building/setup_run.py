"""Running a ``setup.py`` that computes what it installs, to learn what it calls ``setup()`` with.

Building runs ``setup.py`` in ROS as well. Here it runs only when reading it leaves something open,
in a process of its own and with a ``setuptools`` that notes the arguments and does nothing.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

__all__ = ["SetupRunError", "setup_arguments"]

_PATIENCE_S = 60.0
_MARK = "gazelle-setup-arguments:"
_CODE = """
import json, os, runpy, sys, types
from fnmatch import fnmatch

MARK = sys.argv[1]
KEPT = ("name", "version", "packages", "package_dir", "package_data", "py_modules", "data_files",
        "scripts", "entry_points", "install_requires")
given = {}

def setup(**arguments):
    given.update(arguments)

def generate_distutils_setup(**arguments):
    return arguments

def find(where=".", exclude=(), include=("*",), markers=True):
    names = []
    for root, folders, files in os.walk(where):
        folders[:] = sorted(name for name in folders if name.isidentifier())
        name = os.path.relpath(root, where).replace(os.sep, ".")
        if root != where and ("__init__.py" in files or not markers):
            names.append(name)
    chosen = [name for name in names if any(fnmatch(name, item) for item in include)]
    return [name for name in chosen if not any(fnmatch(name, item) for item in exclude)]

def find_namespace(where=".", exclude=(), include=("*",)):
    return find(where, exclude, include, markers=False)

class Anything:
    def __init__(self, *words, **more):
        pass

def module(name, **names):
    made = sys.modules[name] = types.ModuleType(name)
    made.__path__ = []
    made.__dict__.update(names)
    made.__getattr__ = lambda _name: Anything
    return made

tools = {"setup": setup, "find_packages": find, "find_namespace_packages": find_namespace}
for name in ("setuptools", "distutils", "distutils.core"):
    module(name, **tools)
for name in ("setuptools.command", "distutils.command", "catkin_pkg"):
    module(name)
for name in ("build_py", "install", "develop", "build_ext", "egg_info", "install_lib"):
    module("setuptools.command." + name)
module("catkin_pkg.python_setup", generate_distutils_setup=generate_distutils_setup)
sys.argv = ["setup.py", "install"]
sys.path.insert(0, os.getcwd())
runpy.run_path("setup.py", run_name="__main__")
print(MARK + json.dumps({key: given[key] for key in KEPT if key in given}, default=str))
"""


class SetupRunError(Exception):
    """A ``setup.py`` cannot be run; the text says why."""


def setup_arguments(folder: Path) -> dict[str, Any]:
    """Run a package's ``setup.py`` and return the arguments of ``setup()`` that matter here.

    Raises:
        SetupRunError: it fails, takes longer than a minute, or calls no ``setup()``.
    """
    words = [sys.executable, "-c", _CODE, _MARK]
    try:
        done = subprocess.run(
            words, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
            check=False, timeout=_PATIENCE_S, errors="replace",
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired) as error:
        raise SetupRunError(str(error)) from error
    lines = [line for line in done.stdout.splitlines() if line.startswith(_MARK)]
    if not lines:
        last = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.returncode}"]
        raise SetupRunError(last[0])
    found = json.loads(lines[-1].removeprefix(_MARK))
    if not found:
        raise SetupRunError("it calls no setup()")
    return dict(found)
