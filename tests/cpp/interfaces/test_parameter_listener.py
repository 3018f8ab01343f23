"""A node of ROS 2 in C++ whose parameters a file of generate_parameter_library declares."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from tests.conftest import Run

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.cpp.interfaces import parameter_header

_HERE = Path(__file__).parent
_PROGRAM = _HERE / "programs" / "parameterized.cpp"
_YAML = _HERE / "definitions" / "arm_parameters.yaml"


@pytest.fixture(scope="session")
def node_file(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> Path:
    """The compiled program."""
    del shared_cpp_cache
    if sys.platform != "linux":
        pytest.skip("nodes of C++ run on Linux for now")
    try:
        find_toolchain()
    except NoToolchainError as error:
        pytest.skip(str(error))
    folder = tmp_path_factory.mktemp("parameterized")
    parameter_header(_YAML, "arm_parameters", folder)
    output = folder / "node"
    command = [sys.executable, "-m", "gazelle.cpp.compile", str(_PROGRAM), "-o", str(output)]
    command += ["--ros", "2", f"-f=-I{folder}", "-f=-Werror"]
    done = subprocess.run(command, check=False, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    return output


def test_parameters_are_declared_checked_and_followed(gazelle: Run, node_file: Path) -> None:
    words = ("--ros-args", "-p", "needed:=3", "-p", "gains.elbow.p:=0.5")
    running = gazelle(str(node_file), *words, module="gazelle.cpp.host")
    assert running.wait() == 0
    assert [line for line in running.lines if line] == [
        "rate 50.0 needed 3 label arm weights 2",
        "elbow 0.5",
        "now 100.0",
        "rate: set",
        "old 1",
        "mode: Parameter 'mode' with the value 'sideways' is not one of [slow, fast]",
        "needed: parameter 'needed' cannot be set because it is read-only",
        "joints: set",
        "joints 1 wrist 2.0 declared 1",
        "above zero 1 up to 1000",
    ]


def test_a_value_that_is_missing_or_wrong_ends_the_listener(gazelle: Run, node_file: Path) -> None:
    missing = gazelle(str(node_file), module="gazelle.cpp.host")
    assert missing.wait() == 0
    assert any("needed" in line for line in missing.lines if line.startswith("refused: "))
    words = ("--ros-args", "-p", "needed:=3", "-p", "mode:=up")
    wrong = gazelle(str(node_file), *words, module="gazelle.cpp.host")
    assert wrong.wait() == 0
    (line,) = (line for line in wrong.lines if line.startswith("refused: "))
    assert "Invalid value set during initialization for parameter 'mode'" in line
