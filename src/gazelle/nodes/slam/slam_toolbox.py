"""The services of slam_toolbox."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.interfaces import service_type
from gazelle.mapping.grids import MapWriteError, SaveOptions, write_map
from gazelle.mapping.slam import SUFFIX, SavedGraphError, Slam, load_graph, save_graph

if TYPE_CHECKING:
    from gazelle.graph import Node
    from gazelle.nodes.slam.mapper import Mapper

__all__ = ["ToolboxServices"]

_GIVEN_POSE, _LOCALIZE = 2, 3
_NO_MAP, _FAILED = 1, 255


class ToolboxServices:
    """Save, serialise, deserialise, pause, reset."""

    def __init__(self, node: Node, mapper: Mapper) -> None:
        """Offer them under the node's own name."""
        self._node, self._mapper = node, mapper
        with node.announced_together():
            for name, kind, handler in (
                ("save_map", "SaveMap", self._save_map),
                ("serialize_map", "SerializePoseGraph", self._serialize),
                ("deserialize_map", "DeserializePoseGraph", self._deserialize),
                ("pause_new_measurements", "Pause", self._pause),
                ("reset", "Reset", self._reset),
            ):
                offered = service_type(f"slam_toolbox/srv/{kind}")
                node.create_service(f"~/{name}", offered, _answering(handler, offered))

    def load(self, path: Path, start: Sequence[float] | None, *, keeps: bool) -> str:
        """Go on with a saved graph; return what is wrong, empty when nothing is.

        Args:
            path: with or without the suffix, as the original takes it.
            start: where the robot is, (x_m, y_m, yaw_rad); where it began when None.
            keeps: the map stays as it is, the robot is only located.
        """
        path = path if path.suffix == SUFFIX else Path(f"{path}{SUFFIX}")
        try:
            engine = load_graph(path, self._mapper.options.slam)
        except SavedGraphError as error:
            return str(error)
        engine.resume(engine.keyframes.poses[0] if start is None else start)
        engine.is_mapping = not keeps
        self._mapper.replace(engine)
        self._mapper.publish_map()
        self._node.log("info", f"{path}: {len(engine.keyframes)} scans")
        return ""

    def _save_map(self, request: Any, response: Any) -> None:
        grid = self._mapper.grid()
        if grid is None:
            self._node.log("error", "there is no map yet: no scan could be placed")
            response.result = _NO_MAP
            return
        stem = request.name.data or "map"
        try:
            written = write_map(grid, stem, SaveOptions(ros_version=2))
        except MapWriteError as error:
            self._node.log("error", str(error))
            response.result = _FAILED
            return
        self._node.log("info", f"wrote {', '.join(map(str, written))}")

    def _serialize(self, request: Any, response: Any) -> None:
        path = Path(f"{request.filename}{SUFFIX}")
        try:
            with self._mapper.lock:
                save_graph(self._mapper.engine, path)
        except SavedGraphError as error:
            self._node.log("error", str(error))
            response.result = _FAILED
            return
        self._node.log("info", f"wrote {path}")

    def _deserialize(self, request: Any, response: Any) -> None:
        pose = request.initial_pose
        given = request.match_type in (_GIVEN_POSE, _LOCALIZE)
        start = (pose.x, pose.y, pose.theta) if given else None
        if start is not None and not all(map(math.isfinite, start)):
            why = f"initial_pose is {start}, not finite"
        else:
            keeps = request.match_type == _LOCALIZE
            why = self.load(Path(request.filename), start, keeps=keeps)
        if why:
            self._node.log("error", why)
            response.result = _FAILED

    def _pause(self, _request: Any, response: Any) -> None:
        self._mapper.is_paused = not self._mapper.is_paused
        self._node.log("info", "paused" if self._mapper.is_paused else "goes on")
        response.status = True

    def _reset(self, request: Any, _response: Any) -> None:
        self._mapper.is_paused = bool(request.pause_new_measurements)
        self._mapper.replace(Slam(self._mapper.options.slam))


def _answering(handler: Any, kind: Any) -> Any:
    """Return a handler of the graph: it gets a response with result 0 to fill."""

    def answer(request: Any) -> Any:
        response = kind.Response()
        handler(request, response)
        return response

    return answer
