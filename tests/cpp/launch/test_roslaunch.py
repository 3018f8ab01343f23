"""C++ of ROS 1 in launches, with rosrun and after catkin_make."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.cpp.launch.conftest import Gazelle, Workspace, environment
from tests.cpp.launch.ros1_package import FILES, LAUNCH
from tests.patience import stretched

pytestmark = pytest.mark.skipif(os.name == "nt", reason="node files are ELF")

_GOOD = {name: text for name, text in FILES.items() if "bad" not in name and "falls" not in name}
_GOOD["answers/CMakeLists.txt"] = re.sub(
    r"\n[^\n]*\((?:bad|falls) [^\n]*", "", FILES["answers/CMakeLists.txt"]
)
_SHORT = _GOOD | {
    "answers/src/answerer.cpp": "#include <ros/ros.h>\n#include <cstdio>\nint main(int argc, char**"
    ' argv) {\n  ros::init(argc, argv, "short");\n  printf("it is %d\\n", argc);\n}\n'
}


def test_launch_compiles_and_goes_on_without_what_fails_and_what_crashes(
    workspace: Workspace, gazelle: Gazelle
) -> None:
    top = workspace({**FILES, "answers/launch/all.launch": LAUNCH})
    ran = gazelle("roslaunch", "answers", "all.launch", folder=top)
    told = ran.stdout + ran.stderr
    assert ran.returncode == 1, told
    # The compiler's words, at the user's file and line.
    assert f"{top}/src/answers/src/bad.cpp:4" in told
    assert "no_such_name" in told
    # Python and C++ talk.
    assert "ready to answer" in told, told
    assert "python heard who are you!" in told
    assert "answerer ends" in told
    # Who crashes is told by the signal's name, and the others go on.
    assert "signal SIGSEGV, exit code -11" in told
    assert re.search(r"\[falls-\d+\] process has died", told)
    assert not re.search(r"process\[bad-\d+\]", told)


def test_rosrun_compiles_once_and_hands_over_the_terminal(
    workspace: Workspace, gazelle: Gazelle
) -> None:
    top = workspace(_SHORT)
    ran = gazelle("rosrun", "answers", "answerer", "one", "_two:=2", folder=top)
    assert (ran.returncode, ran.stdout) == (0, "it is 2\n"), ran.stderr
    assert "compiling C++ of answers" in ran.stderr
    ran = gazelle("rosrun", "answers", "answerer", folder=top)
    assert (ran.returncode, ran.stdout) == (0, "it is 1\n"), ran.stderr
    assert "compiling C++ of answers" not in ran.stderr


def test_two_that_compile_the_same_at_once_both_run(workspace: Workspace, free_port: int) -> None:
    top = workspace(_SHORT)
    words = [sys.executable, "-m", "gazelle.cli", "rosrun", "answers", "answerer"]
    started = [
        subprocess.Popen(
            words,
            cwd=top,
            env=environment(free_port),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for _ in range(2)
    ]
    told = [process.communicate(timeout=stretched(240.0)) for process in started]
    assert [out for out, _ in told] == ["it is 1\n"] * 2, told


def test_changed_source_is_compiled_anew(workspace: Workspace, gazelle: Gazelle) -> None:
    top = workspace(_SHORT)
    assert gazelle("rosrun", "answers", "answerer", folder=top).stdout == "it is 1\n"
    source = top / "src/answers/src/answerer.cpp"
    source.write_text(source.read_text().replace("it is", "now it is"), encoding="utf-8")
    assert gazelle("rosrun", "answers", "answerer", folder=top).stdout == "now it is 1\n"


def test_catkin_make_puts_programs_into_devel_that_run_by_themselves(
    workspace: Workspace, gazelle: Gazelle
) -> None:
    top = workspace(_SHORT)
    built = gazelle("catkin_make", "install", folder=top)
    assert built.returncode == 0, built.stdout + built.stderr
    assert "Building CXX object" in built.stdout
    assert (top / "build/answers/compile_commands.json").is_file()
    for program in (top / "devel/lib/answers/answerer", top / "install/lib/answers/answerer"):
        ran = subprocess.run(
            [program, "a"], capture_output=True, text=True, timeout=stretched(), check=False
        )
        assert ran.stdout == "it is 2\n", ran.stderr
    ran = gazelle("rosrun", "answers", "answerer", folder=top)
    assert (ran.stdout, "compiling" in ran.stderr) == ("it is 1\n", False)


def test_mistake_fails_catkin_make_with_the_compilers_words(
    workspace: Workspace, gazelle: Gazelle
) -> None:
    broken = _SHORT["answers/src/answerer.cpp"].replace("argc);", "nothing);")
    top = workspace({**_SHORT, "answers/src/answerer.cpp": broken})
    built = gazelle("catkin_make", folder=top)
    assert built.returncode == 1
    assert f"{top}/src/answers/src/answerer.cpp:5" in built.stderr
    assert "'nothing' was not declared" in built.stderr.replace("‘", "'").replace("’", "'")
    assert 'Invoking "make" failed' in built.stderr


@pytest.fixture
def no_compiler(tmp_path: Path) -> Callable[[], str]:
    """Makes a ``PATH`` on which no compiler is."""

    def path() -> str:
        folder = tmp_path / "bin"
        folder.mkdir()
        for name in ("sh", "env", "uname"):
            (folder / name).symlink_to(f"/bin/{name}")
        return str(folder)

    return path


def test_without_a_compiler_the_extra_is_named_once(
    workspace: Workspace, gazelle: Gazelle, no_compiler: Callable[[], str]
) -> None:
    top, path = workspace(_SHORT), no_compiler()
    ran = gazelle("rosrun", "answers", "answerer", folder=top, PATH=path, CXX="")
    assert ran.returncode == 3
    assert ran.stderr.count("pip install 'gazelle-sim[cpp]'") == 1, ran.stderr
    built = gazelle("catkin_make", folder=top, PATH=path, CXX="")
    assert built.returncode == 0, "everything else is built"
    assert "C++ is left out: there is no C++ compiler here" in built.stderr
    assert "executable 'answerer'" in built.stderr
