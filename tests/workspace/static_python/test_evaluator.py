"""Expressions of launch and setup files, followed without running them."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import pytest

from gazelle.workspace.static_python import UNKNOWN, Evaluator


def evaluated(text: str, folder: Path = Path("/nowhere"), **environ: str) -> dict[str, Any]:
    evaluator = Evaluator(folder / "file.py", folder, environ=environ)
    evaluator.run(ast.parse(text))
    return evaluator.names


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("x = 'a' + 'b'", "ab"),
        ("n = 'bot'\nx = f'share/{n}/launch'", "share/bot/launch"),
        ("import os\nx = os.path.join('a', 'b')", "a/b"),
        ("from os.path import join as j\nx = j('a', 'b')", "a/b"),
        ("from pathlib import Path\nx = str(Path('a') / 'b')", "a/b"),
        ("x = '%s_%d' % ('a', 2)", "a_2"),
        ("x = '{}-{b}'.format(1, b=2)", "1-2"),
        ("x = [i + '.py' for i in ['a', 'b'] if i != 'a']", ["b.py"]),
        ("x = []\nfor i in range(3):\n    x.append(i * 2)", [0, 2, 4]),
        ("def f(a, b='c'):\n    return a + b\nx = f('a')", "ac"),
        ("x = 1 if 'a' == 'b' else 2", 2),
        ("import os\nx = os.environ.get('MODEL', 'burger')", "burger"),
        ("import os\nx = os.environ['SET']", "yes"),
        ("x = {**{'a': 1}, 'b': [2]}['b'][0]", 2),
    ],
)
def test_plain_expressions(text: str, value: Any) -> None:
    assert evaluated(text, SET="yes")["x"] == value


@pytest.mark.parametrize(
    "text",
    [
        "import os\nx = os.environ['UNSET']",
        "x = open('/etc/passwd').read()",
        "import subprocess\nx = subprocess.run(['ls']).stdout",
        "x = eval('1')",
        "x = 'a'\nwhile True:\n    x += 'b'",
        "x = 'a'\nfor i in range(5000):\n    x = x + x",
        "x = 2\nfor i in range(5000):\n    x = x * x",
        "x = '%999999999d' % 1",
        "x = '{:999999999}'.format(1)",
        "def f(n):\n    return f(n)\nx = f(1)",
        "x = unknown_name.attribute",
    ],
)
def test_what_only_running_tells_is_unknown(text: str) -> None:
    value = evaluated(text)["x"]
    assert value is UNKNOWN or type(value).__name__ == "Call"


def test_nothing_is_executed(tmp_path: Path) -> None:
    mark = tmp_path / "mark"
    evaluated(f"import os\nos.system('touch {mark}')\nopen('{mark}', 'w')", tmp_path)
    assert not mark.exists()


def test_globs_and_walks_look_at_names_only(tmp_path: Path) -> None:
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "a.launch.py").touch()
    text = "import os\nfrom glob import glob\nx = glob('launch/*.py')\n"
    text += "y = [(root, files) for root, folders, files in os.walk('launch')]\n"
    names = evaluated(text, tmp_path)
    assert names["x"] == ["launch/a.launch.py"]
    assert names["y"] == [("launch", ["a.launch.py"])]


def test_globs_of_paths_look_at_names_only(tmp_path: Path) -> None:
    (tmp_path / "launch" / "more").mkdir(parents=True)
    (tmp_path / "launch" / "a.launch.py").touch()
    (tmp_path / "launch" / "more" / "b.launch.py").touch()
    text = "from pathlib import Path\nhere = Path('launch')\n"
    text += "x = [str(file) for file in here.glob('*.py')]\ny = [*here.rglob('*.py')]\n"
    text += "z = [one.name for one in here.iterdir()]\nu = [*here.glob(unknown)]\n"
    names = evaluated(text, tmp_path)
    assert names["x"] == ["launch/a.launch.py"]
    assert [str(one) for one in names["y"]] == ["launch/a.launch.py", "launch/more/b.launch.py"]
    assert names["z"] == ["a.launch.py", "more"]
    assert names["u"] == [UNKNOWN]


def test_calls_are_noted_with_their_arguments() -> None:
    evaluator = Evaluator(Path("/f.py"), Path("/"))
    text = (
        "from launch_ros.actions import Node as N\ndef g():\n    return [N(package='a', name=X)]\n"
    )
    evaluator.run(ast.parse(text))
    evaluator.call_function("g")
    (call,) = evaluator.calls
    assert (call.function, call.name, call.get("package")) == (
        "launch_ros.actions.Node",
        "Node",
        "a",
    )
    assert call.get("name") is UNKNOWN
