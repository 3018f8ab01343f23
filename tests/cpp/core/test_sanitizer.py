"""The core under AddressSanitizer: memory that is used after its end, or beyond its bounds."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Launched, Run
from tests.patience import eventually

from gazelle.cpp.runtime_libraries import HERE, LIBRARIES
from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type

_PROGRAM = Path(__file__).parent / "programs" / "core_probe.cpp"
_FLAGS = (
    *("-std=gnu++17", "-O0", "-g", "-fPIC", "-fno-omit-frame-pointer", "-fsanitize=address"),
    "-Wno-infinite-recursion",
)
_RUN = """\
import sys
from pathlib import Path
from gazelle.cpp.host.__main__ import run_node_file
from gazelle.process_lifetime import end_at_interrupts
end_at_interrupts()
run_node_file(Path(sys.argv[2]), sys.argv[2:], [Path(sys.argv[1])])
"""
pytestmark = [
    pytest.mark.slow(60),
    pytest.mark.skipif(
        sys.platform != "linux" or shutil.which("g++") is None, reason="needs g++ on Linux"
    ),
]
Probe = Callable[..., Launched]


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The core and the program, compiled with the sanitizer."""
    folder = tmp_path_factory.mktemp("sanitized")
    include = f"-I{HERE / 'include' / 'common'}"

    def compiled(source: Path) -> str:
        made = folder / f"{source.stem}.o"
        _run(["g++", *_FLAGS, include, "-c", str(source), "-o", str(made)])
        return str(made)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        objects = list(pool.map(compiled, LIBRARIES["core"].sources))
    core, program = folder / "libgazelle_core.so", folder / "core_probe"
    shared = ["g++", *_FLAGS, "-shared"]
    soname = "-Wl,-soname,libgazelle_core.so"
    _run([*shared, soname, *objects, "-o", str(core), "-ldl", "-lpthread"])
    _run([*shared, include, str(_PROGRAM), str(core), "-o", str(program)])
    return core, program


@pytest.fixture
def probe(gazelle: Run, files: tuple[Path, Path], tmp_path: Path) -> Probe:
    """Runs the program under the sanitizer, on the test's own graph."""
    # The sanitizer wants to be first, and to find what throws.
    preloaded = " ".join(map(_library, ("libasan.so", "libstdc++.so")))
    (tmp_path / "run_sanitized.py").write_text(_RUN, encoding="utf-8")

    def run(*words: str) -> Launched:
        return gazelle(
            *map(str, files),
            *words,
            module="run_sanitized",
            cwd=tmp_path,
            LD_PRELOAD=preloaded,
            # Python keeps what it has to the end.
            ASAN_OPTIONS="detect_leaks=0",
        )

    return run


@pytest.fixture
def graph(free_port: int) -> Any:
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one


@pytest.mark.parametrize("word", ["code", "inside", "exit"])
def test_a_program_on_its_own_is_clean(probe: Probe, word: str) -> None:
    running = probe(word)
    running.wait()
    assert "AddressSanitizer" not in running.text


def test_topics_both_ways_are_clean(graph: Graph, probe: Probe) -> None:
    string, got = message_type("std_msgs/msg/String"), []
    node = graph.create_node("tester")
    node.create_subscription("out", string, lambda message: got.append(message.data))
    publisher = node.create_publisher("in", string)
    running = probe("echo")
    running.wait_for_line("ready /probe")
    eventually(lambda: publisher.matched and graph.publisher_count("/out"))
    for size in (1, 10_000, 1_000_000):
        publisher.publish(string(data="x" * size))
    eventually(lambda: len(got) == 3)
    assert running.stop(signal.SIGINT) == 0
    assert "AddressSanitizer" not in running.text


def test_services_both_ways_are_clean(graph: Graph, probe: Probe) -> None:
    trigger = service_type("std_srvs/srv/Trigger")
    node = graph.create_node("tester")
    serving = probe("serve")
    serving.wait_for_line("ready")
    assert node.create_client("trigger", trigger).call(trigger.Request()).success
    assert serving.stop(signal.SIGINT) == 0
    node.create_service("trigger", trigger, lambda _one: trigger.Response(success=True))
    asking = probe("ask")
    assert asking.wait() == 0, asking.text
    assert "AddressSanitizer" not in serving.text + asking.text


def _library(name: str) -> str:
    command = ["g++", f"-print-file-name={name}"]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def _run(command: list[str]) -> None:
    outcome = subprocess.run(command, check=False, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stderr
