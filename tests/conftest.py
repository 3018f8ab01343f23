"""Fixtures of all tests: sample workspaces, recorded outputs, launched commands."""

from __future__ import annotations

import contextlib
import itertools
import os
import re
import signal
import site
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import hypothesis
import pytest
from tests.capture import capfd, capsys  # noqa: F401 - fixtures
from tests.distribution import (  # noqa: F401 - hooks
    pytest_collection,
    pytest_collection_modifyitems,
    pytest_xdist_auto_num_workers,
    pytest_xdist_make_scheduler,
)
from tests.garbage import pytest_collection_finish, pytest_configure  # noqa: F401 - hooks
from tests.patience import PATIENCE_S, await_change, eventually, stretched

SHARED = Path(__file__).parents[2] / "shared"
_CPP_CACHE = Path(__file__).parents[1] / ".pytest_cache" / "cpp"
_OWN_FOLDERS = ("HOME", "ROS_HOME", "USERPROFILE", "XDG_CACHE_HOME", "XDG_CONFIG_HOME")
_OWN_FOLDERS += ("XDG_STATE_HOME",)
# What programs that tests need find by the true home.
_FOUND_BY_HOME = {"PLAYWRIGHT_BROWSERS_PATH": ".cache/ms-playwright", "PYENV_ROOT": ".pyenv"}
# Its own limits are of wall time.
hypothesis.settings.register_profile(
    "patient", deadline=None, suppress_health_check=[hypothesis.HealthCheck.too_slow]
)
hypothesis.settings.load_profile("patient")
# Windows that launch files name serve no page, except in the tests of the page.
os.environ["GAZELLE_STUDIO"] = "0"
# Workers and what they start, some thousand processes, share the processors.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
_RUN_MARK = "TESTS_COMMANDS"
_RUN_NUMBERS = itertools.count()
_PORT_NUMBERS = itertools.count(os.getpid() % 500)
if sys.dont_write_bytecode:
    # Some containers say so, and each of some thousand processes would compile all modules anew.
    # Nothing is written beside the sources all the same; workers get the variables from here.
    sys.pycache_prefix = str(Path(__file__).parents[1] / ".pytest_cache" / "bytecode")
    sys.dont_write_bytecode = False
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix


@pytest.fixture(scope="session", autouse=True)
def own_folders(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """What the person who runs the tests has at home is neither read nor written."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONUSERBASE", site.getuserbase())
        # What the environment of these tests has is no part of the tests of a user, run inside.
        patch.setenv("PYTEST_ADDOPTS", "-p no:randomly")
        for variable, folder in _FOUND_BY_HOME.items():
            if variable not in os.environ and (found := Path.home() / folder).is_dir():
                patch.setenv(variable, str(found))
        for variable in _OWN_FOLDERS:
            patch.setenv(variable, str(tmp_path_factory.mktemp(variable.lower())))
        # Compiled C++ is kept beside what pytest keeps: to make it anew takes minutes.
        patch.setenv("GAZELLE_CPP_CACHE", str(_CPP_CACHE))
        yield


@pytest.fixture(autouse=True)
def own_environment() -> Iterator[None]:
    """A test that leaves variables or another folder to those after it fails itself."""
    variables, folder = dict(os.environ), Path.cwd()
    yield
    changed = sorted(
        name
        for name, _ in dict(os.environ).items() ^ variables.items()
        if name != "PYTEST_CURRENT_TEST"
    )
    moved = Path.cwd() != folder
    if changed or moved:
        os.environ.clear()
        os.environ.update(variables)
        os.chdir(folder)
        pytest.fail(f"left to other tests: {', '.join(dict.fromkeys(changed))} {'cwd' * moved}")


@pytest.fixture(autouse=True)
def own_definitions() -> Iterator[None]:
    """What a test's peers, bags and workspaces say of types is forgotten after it."""
    yield
    # What was never imported has learned nothing.
    loaded: Callable[[str], Any] = sys.modules.get
    if interfaces := loaded("gazelle.interfaces"):
        interfaces.default_types().reset()


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """The folder with sample workspaces and recorded outputs of real programs."""
    if not SHARED.is_dir():
        pytest.skip(f"sample workspaces are not here ({SHARED})")
    return SHARED


@pytest.fixture(scope="session")
def workspaces_dir(shared_dir: Path) -> Path:
    """The documents' own packages, unmodified."""
    return shared_dir / "workspaces"


@pytest.fixture(scope="session")
def own_workspaces_dir() -> Path:
    """Small packages of the tests' own: ``ros1/src`` and ``ros2/src``; also in a clone alone."""
    return Path(__file__).parent / "workspaces"


@pytest.fixture(scope="session")
def examples_dir() -> Path:
    """The workspaces that the documentation shows."""
    return Path(__file__).parents[1] / "examples"


@pytest.fixture(scope="session")
def oracles_dir(shared_dir: Path) -> Path:
    """Recorded outputs of real ROS and Gazebo programs."""
    return shared_dir / "oracles"


class Launched:
    """A command that runs in a session of its own: its output and the graph it is on.

    Attributes:
        popen: the process.
        port: of its graph.
        lines: what it has written so far.
    """

    def __init__(
        self, words: list[str], *, port: int, cwd: Path, environ: dict[str, str], stdin: Any
    ) -> None:
        self.port = port
        self.lines: list[str] = []
        self._changed = threading.Condition()
        self._graph: Any = None
        self._node: Any = None
        self.popen = subprocess.Popen(
            words, cwd=cwd, env=environ, text=True, start_new_session=True, stdin=stdin,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace",
        )  # fmt: skip
        self._run_mark = environ.get(_RUN_MARK)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def text(self) -> str:
        """Everything written so far."""
        return "\n".join(self.lines)

    @property
    def graph(self) -> Any:
        """The launch's graph, joined when first asked for."""
        if self._graph is None:
            # What these say first; only roslaunch has the graph by then.
            self.wait_for_line("ROS_MASTER_URI=|Default logging verbosity|the world is paused")
            self._graph = self.eventually(self._joined)
        return self._graph

    @property
    def node(self) -> Any:
        """A node of the test on that graph."""
        if self._node is None:
            self._node = self.graph.create_node("test", anonymous=True, rosout=False)
        return self._node

    def wait_for_line(self, pattern: str, timeout_s: float = PATIENCE_S) -> str:
        """Return the first line that a regular expression finds something in."""

        def found() -> str:
            return next((line for line in self.lines if re.search(pattern, line)), "")

        with self._changed:
            assert await_change(self._changed, lambda: found() or self._ended, timeout_s), self.text
            assert found(), f"no line matches {pattern!r}:\n{self.text}"
            return found()

    def messages(
        self, wanted: dict[str, int], timeout_s: float = PATIENCE_S
    ) -> dict[str, list[Any]]:
        """Return so many messages of each topic, all gathered at the same time."""
        got: dict[str, list[Any]] = {topic: [] for topic in wanted}
        done = threading.Condition()

        def take(topic: str) -> Callable[[Any], None]:
            def on_message(message: Any) -> None:
                with done:
                    got[topic].append(message)
                    done.notify_all()

            return on_message

        listening = [
            self.node.create_subscription(topic, self._type(topic), take(topic)) for topic in wanted
        ]

        def complete() -> bool:
            return all(len(got[topic]) >= count for topic, count in wanted.items())

        with done:
            in_time = await_change(done, complete, timeout_s)
            counts = {topic: len(items) for topic, items in got.items()}
        assert in_time, f"{counts} of {wanted}\n{self.text}"
        for subscription in listening:
            subscription.unregister()
        return got

    def publish(self, topic: str, type_name: str, **fields: Any) -> Any:
        """Publish a message as soon as somebody listens; returns the publisher."""
        from gazelle.interfaces import fill, message_type

        message_class = message_type(type_name)
        publisher = self.node.create_publisher(topic, message_class)
        self.eventually(lambda: publisher.matched)
        message = message_class()
        fill(message, fields)
        publisher.publish(message)
        return publisher

    def call(self, service: str, type_name: str, **fields: Any) -> Any:
        """Call a service and return its response; a world's also where it is hidden."""
        from gazelle.graph.gazebo_names import offered_name
        from gazelle.interfaces import fill, service_type

        kind = service_type(type_name)
        limit_s = stretched()
        client = self.node.create_client(offered_name(self.graph, service, limit_s), kind)
        assert client.wait_for_service(limit_s), f"no {service}\n{self.text}"
        request = kind.Request()
        fill(request, fields)
        return client.call(request, timeout_s=limit_s)

    def eventually(self, condition: Callable[[], Any], timeout_s: float = PATIENCE_S) -> Any:
        """Return what a condition gives as soon as that is true."""
        return eventually(condition, timeout_s, why=lambda: self.text)

    def wait(self, timeout_s: float = PATIENCE_S) -> int:
        """Wait for the end and return the exit code."""
        code = self.popen.wait(stretched(timeout_s))
        self._reader.join(stretched(timeout_s))
        return code

    def stop(self, number: int = signal.SIGINT) -> int:
        """Send a signal and return the exit code."""
        self.popen.send_signal(number)
        return self.wait()

    def processes(self) -> dict[int, str]:
        """Return the command lines of all processes on this graph's port, the test's apart."""
        return self._processes(lambda environ: True)

    def _processes(self, belongs: Callable[[dict[str, str]], bool]) -> dict[int, str]:
        import psutil

        found: dict[int, str] = {}
        for process in psutil.process_iter():
            with contextlib.suppress(psutil.Error):
                environ = process.environ()
                on_port = environ.get("GAZELLE_PORT") == str(self.port)
                if on_port and belongs(environ) and process.status() != psutil.STATUS_ZOMBIE:
                    found[process.pid] = " ".join(process.cmdline())
        return found

    def close(self) -> None:
        """End whatever is left."""
        if self._graph is not None:
            self._graph.close()
        if self.popen.poll() is None:
            self.popen.send_signal(signal.SIGTERM)
            with contextlib.suppress(subprocess.TimeoutExpired):
                self.popen.wait(stretched())
        # What a module's tests share stays when one of them ends.
        for pid in self._processes(lambda environ: environ.get(_RUN_MARK) == self._run_mark):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        self.popen.wait(stretched())

    def _joined(self) -> Any:
        from gazelle.graph import Graph, NoGraphError

        try:
            return Graph.open(port=self.port, role="client", environ={})
        except NoGraphError:
            return None

    @property
    def _ended(self) -> bool:
        return not self._reader.is_alive()

    def _type(self, topic: str) -> str:
        def named() -> str:
            pairs = self.graph.topic_names_and_types()
            return next((kind for name, kind in pairs if name == topic and kind != "*"), "")

        return str(self.eventually(named))

    def _read(self) -> None:
        assert self.popen.stdout is not None
        with self.popen.stdout:
            for line in self.popen.stdout:
                with self._changed:
                    self.lines.append(line.rstrip("\n"))
                    self._changed.notify_all()
        self._reader_ended()

    def _reader_ended(self) -> None:
        with self._changed:
            self._changed.notify_all()


@contextlib.contextmanager
def reserved_port() -> Iterator[int]:
    """A port nobody listens on, and that no other test of this machine gets meanwhile.

    It lies below the range that the system hands out by itself: a port asked for with number 0
    may go to some peer's own listener before the test's hub takes it. The UDP port of the same
    number, which nothing here uses, keeps other runs of the tests off it.
    """
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    for number in _PORT_NUMBERS:
        port = 12_000 + worker % 8 * 2_000 + number % 2_000
        with socket.socket(type=socket.SOCK_DGRAM) as mark, contextlib.suppress(OSError):
            mark.bind(("127.0.0.1", port))
            with socket.socket() as probe:
                probe.bind(("127.0.0.1", port))
            yield port
            return
    raise AssertionError("itertools.count ends")


@pytest.fixture
def stranger(free_port: int) -> Iterator[int]:
    """The number of a graph where a program listens in the hub's place and never says a word."""
    from gazelle.graph import locators

    if not hasattr(socket, "AF_UNIX"):
        with socket.create_server(("127.0.0.1", free_port)):
            yield free_port
        return
    release = locators.claim_hub(free_port)
    assert release is not None
    place = Path(locators.name_of_hub(free_port))
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(place))
        server.listen()
        yield free_port
    place.unlink()
    release()


@pytest.fixture
def next_port() -> Iterator[Callable[[], int]]:
    """Gives ports that nobody else gets before the test has ended."""
    with contextlib.ExitStack() as reserved:
        yield lambda: reserved.enter_context(reserved_port())


@pytest.fixture
def free_port(next_port: Callable[[], int]) -> int:
    """The port of the test's graph."""
    return next_port()


Run = Callable[..., Launched]


@contextlib.contextmanager
def commands(folder: Path, graph_port: int) -> Iterator[Run]:
    """Give what runs ``gazelle WORDS…`` in a folder and on a port; everything ends with it."""
    running: list[Launched] = []
    mark = f"{os.getpid()}-{next(_RUN_NUMBERS)}"

    def run(
        *words: str,
        cwd: Path = folder,
        port: int = graph_port,
        stdin: Any = None,
        module: str = "gazelle.cli",
        **environ: str,
    ) -> Launched:
        clean = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "GAZELLE_"))}
        own = {"GAZELLE_PORT": str(port), "ROS_HOME": str(folder / "ros_home")}
        own |= {"GAZELLE_CPP_CACHE": str(_CPP_CACHE), "GAZELLE_STUDIO": "0"}
        own |= {_RUN_MARK: mark, **environ}
        command = [sys.executable, "-m", module, *words]
        running.append(Launched(command, port=port, cwd=cwd, environ={**clean, **own}, stdin=stdin))
        return running[-1]

    try:
        yield run
    finally:
        for one in reversed(running):
            one.close()


@pytest.fixture(scope="module")
def module_port() -> Iterator[int]:
    """The port of a graph that a module's tests share."""
    with reserved_port() as port:
        yield port


@pytest.fixture(scope="module")
def module_gazelle(tmp_path_factory: pytest.TempPathFactory, module_port: int) -> Iterator[Run]:
    """As `gazelle`, for what a module's tests look at together; ends with the module."""
    with commands(tmp_path_factory.mktemp("module"), module_port) as run:
        yield run


@pytest.fixture
def gazelle(tmp_path: Path, free_port: int) -> Iterator[Run]:
    """Runs ``gazelle WORDS…`` on a port of the test's own; everything ends with the test.

    `module` is run in place of ``gazelle``, as ``python -m`` does.
    """
    with commands(tmp_path, free_port) as run:
        yield run


@pytest.fixture
def in_workspace(gazelle: Run, workspaces_dir: Path) -> Run:
    """Runs ``gazelle WORDS…`` in the documents' catkin workspace, with their models."""
    return _in(workspaces_dir, gazelle)


@pytest.fixture(scope="module")
def module_in_workspace(module_gazelle: Run, workspaces_dir: Path) -> Run:
    """As `in_workspace`, for what a module's tests look at together."""
    return _in(workspaces_dir, module_gazelle)


def _in(workspaces: Path, gazelle: Run) -> Run:
    def run(*words: str, **options: Any) -> Launched:
        options.setdefault("cwd", workspaces / "catkin_ws")
        options.setdefault("GAZEBO_MODEL_PATH", str(workspaces / "gazebo_models"))
        return gazelle(*words, **options)

    return run
