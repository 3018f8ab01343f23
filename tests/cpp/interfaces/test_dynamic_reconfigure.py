"""A node of C++ whose parameters a client of Python changes while it runs."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.conftest import Run
from tests.patience import PATIENCE_S, eventually, stretched

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.cpp.interfaces import config_header
from gazelle.graph import Graph
from gazelle.graph.dynamic_reconfigure import ReconfigureClient

_CFG = Path(__file__).parent / "definitions" / "Arm.cfg"
_PROGRAM = Path(__file__).parent / "programs" / "reconfigured.cpp"


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
    folder = tmp_path_factory.mktemp("reconfigured")
    config_header(_CFG, "my_package", folder / "include")
    output = folder / "node"
    command = [sys.executable, "-m", "gazelle.cpp.compile", str(_PROGRAM), "-o", str(output)]
    command += ["--ros", "1", "--lib", "dynamic_reconfigure", f"-f=-I{folder / 'include'}"]
    done = subprocess.run([*command, "-f=-Werror"], check=False, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    return output


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """The test's graph."""
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one


def test_a_client_of_python_changes_parameters_of_cpp(
    graph: Graph, gazelle: Run, node_file: Path
) -> None:
    graph.parameters.set("/arm/gain", 0.25)
    running = gazelle(str(node_file), module="gazelle.cpp.host")
    running.wait_for_line("largest 1 of 1")
    assert "size 1 gain 0.25 name Bob on 1 level ffffffff" in running.lines
    client = ReconfigureClient(graph.create_node("tester"), "/arm")
    assert client.wait_for_server(stretched(PATIENCE_S))
    found = client.set({"size": 7, "name": "wrong"}, timeout_s=stretched(PATIENCE_S))
    assert found is not None
    assert (found["size"], found["name"], found["on"]) == (1, "right", True)
    running.wait_for_line("size 1 gain 0.25 name wrong on 1 level 4")
    eventually(lambda: graph.parameters.get("/arm/name") == "right")
    description = client.wait_for_description(stretched(PATIENCE_S))
    assert description is not None
    assert [group.name for group in description.groups] == ["Fine_tuning"]
    client.close()
