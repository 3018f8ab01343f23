"""``bag.record``: topics into a bag."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import TypedDict

from gazelle.bag.formats import OWN_FORMATS
from gazelle.bag.recording import Recorder, Ros1Files, Selection, default_stem
from gazelle.bag.rosbag2 import Rosbag2Writer
from gazelle.documents.files import exists
from gazelle.graph import Graph, Node
from gazelle.studio.errors import StudioError

__all__ = ["FORMATS", "RecorderState", "Recording"]

_BY_KIND = {one.suffix.removeprefix("."): one for one in OWN_FORMATS}
FORMATS = tuple(_BY_KIND)
_FLUSH_S = 10.0


class RecorderState(TypedDict):
    """A bag that is being recorded.

    Attributes:
        dropped: messages that came faster than they were written.
    """

    path: str
    seconds: float
    messages: int
    dropped: int
    bytes: int
    topics: list[str]


class Recording:
    """The recorder of a graph's pages; all pages see the same one."""

    def __init__(self, graph: Graph, folder: Path) -> None:
        """Record nothing; bags of the graph are written below a folder, and nowhere else."""
        self._graph = graph
        self._folder = folder
        self._lock = threading.Lock()
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._recorder: Recorder | None = None
        self._sink: Ros1Files | Rosbag2Writer | None = None
        self._node: Node | None = None
        self._path = ""
        self._begun_s = 0.0

    def begin(self, topics: list[str] | None, path: str, kind: str) -> str:
        """Record until `stop`.

        Args:
            topics: global names; None for all that are not hidden.
            path: file or folder, made up of the date when empty; ``.bag`` is added.
            kind: one of `FORMATS`.

        Returns:
            where it goes.

        Raises:
            StudioError: something is being recorded already, the file is there already, or it is
                not below the folder.
            BagError: the file cannot be written.
        """
        with self._lock:
            if self._recorder is not None:
                raise StudioError(f"{self._path} is being recorded; stop that first")
            self._sink, self._path = _sink(self._folder, path, kind)
            self._node = self._graph.create_node("record", anonymous=True, rosout=False)
            self._graph.clock.follow(self._node)
            selection = Selection(tuple(topics or ()), topics is None, hidden=False)
            self._recorder = Recorder(self._graph, self._node, self._sink)
            self._recorder.begin(selection)
            self._stop = threading.Event()
            self._begun_s = time.monotonic()
            self._thread = threading.Thread(
                target=self._recorder.run, args=(selection, self._stop), name="recorder"
            )
            self._thread.start()
            return self._path

    def stop(self) -> str:
        """End recording and return where it went; empty when nothing was recorded."""
        with self._lock:
            thread, node, path = self._thread, self._node, self._path
            if thread is None or node is None:
                return ""
            self._stop.set()
            thread.join(_FLUSH_S)
            node.shutdown()
            self._thread = self._recorder = self._sink = self._node = None
            return path

    def close(self) -> None:
        """End recording."""
        self.stop()

    def state(self) -> RecorderState | None:
        """Return what the page shows; None while nothing is recorded."""
        recorder, sink = self._recorder, self._sink
        if recorder is None or sink is None:
            return None
        return {
            "path": self._path,
            "seconds": time.monotonic() - self._begun_s,
            "messages": recorder.written,
            "dropped": recorder.dropped,
            "bytes": sink.size,
            "topics": sorted(recorder.topics),
        }


def _sink(root: Path, path: str, kind: str) -> tuple[Ros1Files | Rosbag2Writer, str]:
    if kind not in FORMATS:
        raise StudioError(f"there is no format '{kind}'", known=FORMATS)
    form = _BY_KIND[kind]
    is_bag = not form.in_folder
    made_up = default_stem() if is_bag else time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S")
    name = str(_below(root, path or made_up))
    stem = name.removesuffix(form.suffix) if is_bag else name
    target = Path(f"{stem}{form.suffix}" if is_bag else name)
    if exists(target):
        raise StudioError(f"{target} is there already", hint="record to another name")
    if is_bag:
        return Ros1Files(lambda: stem), str(target)
    return Rosbag2Writer(target, form.name), str(target)


def _below(root: Path, path: str) -> Path:
    wanted = root / Path(path).expanduser()
    if not wanted.resolve().is_relative_to(root.resolve()):
        raise StudioError(
            f"{wanted} is not below {root}, where this page may write",
            hint="record to another name, or start the page with --folder",
        )
    return wanted
