"""Marker, MarkerArray and InteractiveMarkers: changes, of which none may be left out."""

from __future__ import annotations

import threading
from typing import Annotated, Any, NotRequired, TypedDict

from gazelle.geometry.pose import IDENTITY_POSE
from gazelle.interfaces import message_type, service_type
from gazelle.sensors.scene_json_types import Floats7, MeshFile
from gazelle.studio.displays.topic_display import Site
from gazelle.studio.errors import StudioError
from gazelle.studio.frame_manager import pose_values
from gazelle.studio.json_text import message_value
from gazelle.studio.scenes.shapes import MeshPartValue, mesh_geometry
from gazelle.studio.streams import OpenStream, every
from gazelle.studio.subscriptions import Sample, stamp_s
from gazelle.workspace import Workspace

__all__ = [
    "InteractiveFrame",
    "InteractiveMarkers",
    "MarkerFrame",
    "MarkerList",
    "MarkerMesh",
    "open_interactive",
    "open_markers",
]

_MESH = 10
_DELETE_ALL = 3
_MAX_WAITING = 20_000
_RETRY_S = 0.5
_WAIT_S = 10.0
_SERVICE_S = 2.0
_GET = "visualization_msgs/srv/GetInteractiveMarkers"
_INIT = "visualization_msgs/msg/InteractiveMarkerInit"


class MarkerMesh(TypedDict):
    """What is added to a marker with a mesh: its parts, none where it cannot be read."""

    mesh: NotRequired[list[MeshPartValue]]


class MarkerList(TypedDict):
    """Markers that came, of `visualization_msgs/Marker` and `MarkerArray` alike."""

    markers: list[Annotated[Any, "visualization_msgs/msg/Marker"]]


class MarkerFrame(TypedDict):
    """A frame of the displays Marker and MarkerArray.

    Attributes:
        poses: of each marker's frame in the fixed one.
    """

    pose: None
    stamp_s: float
    frame: str
    message: MarkerList
    poses: list[Floats7]


class InteractiveMarkers(TypedDict):
    """What changed of a server's interactive markers; `erases` are names of those that went."""

    server_id: str
    markers: list[Annotated[Any, "visualization_msgs/msg/InteractiveMarker"]]
    poses: list[Annotated[Any, "visualization_msgs/msg/InteractiveMarkerPose"]]
    erases: list[str]


class InteractiveFrame(TypedDict):
    """A frame of the display InteractiveMarkers.

    Attributes:
        poses: of each marker's frame in the fixed one.
    """

    pose: None
    stamp_s: float
    frame: str
    message: InteractiveMarkers
    poses: list[Floats7]


def open_markers(site: Site) -> OpenStream:
    """Displays Marker and MarkerArray, of a topic of either type."""
    markers = _Markers(site)
    leave = site.subscriptions.listen(site.params.text("topic"), markers.take)
    every(site.channel, _RETRY_S, markers.again)
    return OpenStream(leave)


class _Markers:
    """Gathers markers since the last frame, and those whose frame is not known yet."""

    def __init__(self, site: Site) -> None:
        self._site = site
        self._lock = threading.Lock()
        self._samples: list[Sample] = []
        self._late: list[tuple[Any, float]] = []
        self._meshes = _Meshes(site)

    def take(self, sample: Sample) -> None:
        """Runs in the transport's thread."""
        with self._lock:
            self._samples.append(sample)
            del self._samples[:-_MAX_WAITING]
        self._site.channel.offer(self._frame)

    def again(self) -> None:
        if self._samples or self._late:
            self._site.channel.offer(self._frame)

    def _waiting(self) -> list[tuple[Any, float]]:
        """Return the markers that came, behind those that wait for their frame."""
        with self._lock:
            samples, self._samples = self._samples, []
        for sample in samples:
            message = self._site.message(sample)
            if not hasattr(message, "markers") and not hasattr(message, "ns"):
                raise StudioError(f"{message.TYPE_NAME} is no marker")
            for one in getattr(message, "markers", [message]):
                if one.action == _DELETE_ALL:
                    self._late = []
                self._late.append((one, sample.time_s))
        found, self._late = self._late, []
        return found[-_MAX_WAITING:]

    def _frame(self) -> MarkerFrame | None:
        waiting = self._waiting()
        shown, poses, late = [], [], []
        problem = ""
        now_s = self._site.frames.clock.now_ns() * 1e-9
        for one, came_s in waiting:
            try:
                poses.append(list(pose_values(_pose(self._site, one))))
            except StudioError as error:
                problem = str(error)
                # Its frame may still come; RViz waits as well.
                if now_s - came_s < _WAIT_S:
                    late.append((one, came_s))
                continue
            shown.append(self._meshes.with_mesh(one))
        self._late = late
        if not shown:
            if problem:
                raise StudioError(problem)
            return None
        if problem:
            self._site.channel.status("error", problem)
        last = waiting[-1][0]
        return {
            "pose": None,
            "stamp_s": stamp_s(last, now_s),
            "frame": last.header.frame_id,
            "message": {"markers": shown},
            "poses": poses,
        }


def _pose(site: Site, marker: Any) -> Any:
    # Deleting needs no place.
    return site.pose(marker.header) if marker.header.frame_id else IDENTITY_POSE


class _Meshes:
    """Meshes of markers by their URI, each read once."""

    def __init__(self, site: Site) -> None:
        self._assets = site.assets
        self._known: dict[str, Any] = {}
        self._workspace: Workspace | None = None

    def with_mesh(self, marker: Any) -> dict[str, Any]:
        """Return a marker's value, the parts of its mesh in it if it has one."""
        value: dict[str, Any] = message_value(marker, None)
        uri = marker.mesh_resource
        if marker.type == _MESH and uri:
            if uri not in self._known:
                self._known[uri] = self._read(uri)
            value["mesh"] = self._known[uri]
        return value

    def _read(self, uri: str) -> list[MeshPartValue]:
        self._workspace = self._workspace or Workspace.discover()
        found = self._workspace.resolve(uri).path
        file: MeshFile = {
            "type": "mesh", "uri": uri, "path": str(found or ""), "scale": [1.0, 1.0, 1.0],
            "submesh": "", "center_submesh": False,
        }  # fmt: skip
        geometry = mesh_geometry(file, self._assets)
        return geometry["parts"] if geometry["type"] == "mesh" else []


def open_interactive(site: Site) -> OpenStream:
    """Display InteractiveMarkers of ``…/update``; all markers come first, from where they are."""
    topic = site.params.text("topic")
    base = topic.removesuffix("/update").removesuffix("/update_full")
    markers = _Interactive(site)
    ends = [
        site.subscriptions.listen(f"{base}/update_full", markers.take),
        site.subscriptions.listen(f"{base}/update", markers.take),
    ]
    markers.ask(f"{base}/get_interactive_markers")
    every(site.channel, _RETRY_S, markers.again)

    def close() -> None:
        for end in ends:
            end()

    return OpenStream(close)


class _Interactive:
    """What changed since the last frame: whole markers, poses, and names of those that went."""

    def __init__(self, site: Site) -> None:
        self._site = site
        self._lock = threading.Lock()
        self._server = ""
        self._samples: list[Sample] = []
        self._markers: dict[str, Any] = {}
        self._poses: dict[str, Any] = {}
        self._erased: set[str] = set()
        self._meshes = _Meshes(site)

    def ask(self, service: str) -> None:
        """Get all markers from a server of ROS 2; one of ROS 1 tells them on ``update_full``."""
        offered = {
            one.name for one in self._site.subscriptions.node.graph.services(include_hidden=True)
        }
        if service not in offered:
            return
        kind = service_type(_GET)
        client = self._site.subscriptions.node.create_client(service, kind)
        try:
            answer = client.call(kind.Request(), _SERVICE_S)
        finally:
            client.unregister()
        self._merge(message_type(_INIT)(markers=answer.markers))
        self._site.channel.offer(self._frame)

    def take(self, sample: Sample) -> None:
        """Runs in the transport's thread."""
        with self._lock:
            self._samples.append(sample)
        self._site.channel.offer(self._frame)

    def again(self) -> None:
        if self._samples or self._markers or self._poses or self._erased:
            self._site.channel.offer(self._frame)

    def _merge(self, message: Any) -> None:
        with self._lock:
            self._server = getattr(message, "server_id", "") or self._server
            for one in message.markers:
                self._markers[one.name] = one
                self._poses.pop(one.name, None)
                self._erased.discard(one.name)
            for one in getattr(message, "poses", ()):
                self._poses[one.name] = one
            for name in getattr(message, "erases", ()):
                self._markers.pop(name, None)
                self._poses.pop(name, None)
                self._erased.add(name)

    def _frame(self) -> InteractiveFrame | None:
        with self._lock:
            samples, self._samples = self._samples, []
        for sample in samples:
            message = self._site.message(sample)
            if not hasattr(message, "markers"):
                raise StudioError(f"{message.TYPE_NAME} brings no interactive markers")
            self._merge(message)
        with self._lock:
            markers, self._markers = self._markers, {}
            poses, self._poses = self._poses, {}
            erased, self._erased = self._erased, set()
        placed = {name: self._place(one) for name, one in markers.items()}
        if problem := next((one for one in placed.values() if isinstance(one, str)), ""):
            self._site.channel.status("error", problem)
        with self._lock:
            late = {name: one for name, one in markers.items() if isinstance(placed[name], str)}
            self._markers = late | self._markers
        shown = [one for name, one in markers.items() if name not in late]
        if not (shown or poses or erased):
            return None
        return {
            "pose": None,
            "stamp_s": self._site.frames.clock.now_ns() * 1e-9,
            "frame": shown[0].header.frame_id if shown else "",
            "message": {
                "server_id": self._server,
                "markers": [self._value(one) for one in shown],
                "poses": [message_value(one) for one in poses.values()],
                "erases": sorted(erased),
            },
            "poses": [placed[one.name] for one in shown],
        }

    def _place(self, marker: Any) -> Any:
        try:
            return list(pose_values(self._site.pose(marker.header)))
        except StudioError as error:
            return str(error)

    def _value(self, marker: Any) -> dict[str, Any]:
        value: dict[str, Any] = message_value(marker, None)
        for control, told in zip(marker.controls, value["controls"], strict=True):
            told["markers"] = [self._meshes.with_mesh(one) for one in control.markers]
        return value
