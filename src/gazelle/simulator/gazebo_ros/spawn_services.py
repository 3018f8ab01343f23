"""Services that bring models and take them away."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.errors import GazelleError, UserFileError
from gazelle.interfaces.poses import pose_of
from gazelle.simulator.description_sources import models_from
from gazelle.simulator.gazebo_ros.model_services import Entities, Row

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["SpawnServices"]

_ROS1 = "SpawnModel"
Report = Callable[[Diagnostics], None]


class SpawnServices:
    """``spawn_urdf_model``, ``spawn_sdf_model``, ``delete_model`` and their ROS 2 kin."""

    def __init__(self, server: WorldServer, entities: Entities, report: Report) -> None:
        """Take over what to tell about the models' files."""
        self._server = server
        self._entities = entities
        self._report = report

    def rows(self) -> list[Row]:
        """Return the services below ``/gazebo``."""
        return [
            Row("spawn_urdf_model", "gazebo_msgs/SpawnModel", self._spawn_urdf),
            Row("spawn_sdf_model", "gazebo_msgs/SpawnModel", self._spawn_model),
            Row("delete_model", "gazebo_msgs/DeleteModel", self._delete_model),
        ]

    def ros2_rows(self) -> list[Row]:
        """Return the services that ROS 2 offers at the root."""
        return [
            Row("spawn_entity", "gazebo_msgs/SpawnEntity", self._spawn_entity),
            Row("delete_entity", "gazebo_msgs/DeleteEntity", self._delete_entity),
        ]

    def _spawn_urdf(self, request: Any, response: Any) -> None:
        if "<robot" not in request.model_xml:
            response.success = False
            response.status_message = "SpawnModel: Failure - entity format is invalid."
            return
        self._spawn_model(request, response)

    def _spawn_model(self, request: Any, response: Any) -> None:
        self._spawn(_ROS1, request.model_name, request.model_xml, request, response)

    def _spawn_entity(self, request: Any, response: Any) -> None:
        name, text = request.name, request.xml
        self._spawn("SpawnEntity", name, text, request, response)
        if response.success:
            response.status_message = f"SpawnEntity: Successfully spawned entity [{name}]"

    def _spawn(self, word: str, name: str, text: str, request: Any, response: Any) -> None:
        frame = self._entities.frame(request.reference_frame)
        response.success = False
        if frame is None:
            response.status_message = f"{word}: reference reference_frame not found, did you "
            response.status_message += "forget to scope the link by model name?"
            return
        if self._server.engine.world.model(name) is not None:
            text = f"{word}: Failure - entity already exists."
            # ROS 2's factory has words of its own.
            response.status_message = text if word == _ROS1 else f"Entity [{name}] already exists."
            return
        pose = frame.T_world_entity @ pose_of(request.initial_pose).normalised()
        found = Diagnostics()
        already = len(self._server.diagnostics)
        try:
            models = self._read(text, found)
            for model in models:
                chosen = name if len(models) == 1 and name else model.name
                placed = replace(model, T_world_model=pose @ model.T_world_model)
                self._server.spawn(placed, name=chosen, namespace=request.robot_namespace)
        except GazelleError as error:
            response.status_message = f"{word}: Failure - {_in_short(error)}"
            self._report(found)
            return
        for item in list(self._server.diagnostics)[already:]:
            found.add(item)
        self._server.diagnostics.extend(found)
        self._report(found)
        response.success = True
        response.status_message = f"{word}: Successfully spawned entity"

    def _read(self, text: str, found: Diagnostics) -> tuple[Model, ...]:
        workspace = self._server.workspace
        if workspace is None:
            from gazelle.workspace import Workspace

            workspace = Workspace.discover()
        models = models_from(text, workspace, found)
        found.raise_if_errors()
        if not models:
            raise GazelleError(
                "input model_xml not SDF or URDF, or cannot be converted to Gazebo compatible"
                " format."
            )
        return models

    def _delete_model(self, request: Any, response: Any) -> None:
        self._delete("DeleteModel", request.model_name, response)

    def _delete_entity(self, request: Any, response: Any) -> None:
        self._delete("DeleteEntity", request.name, response)

    def _delete(self, word: str, name: str, response: Any) -> None:
        if self._entities.model(name) is None:
            response.success = False
            response.status_message = f"{word}: model does not exist" + self._entities.hint(name)
            return
        self._server.delete(name)
        response.success = True
        response.status_message = f"{word}: successfully deleted model"


def _in_short(error: GazelleError) -> str:
    """Return an error for the caller; findings in full go to the simulator's own terminal."""
    if not isinstance(error, UserFileError):
        return str(error)
    found = [item for item in error.diagnostics if item.severity is Severity.ERROR]
    if all(item.code == "load.nothing" for item in found):
        # The reason is a warning: the one model of a text may be an include that is not found.
        found = [item for item in error.diagnostics if item.severity >= Severity.WARNING]
    return "; ".join(f"{item.span}: {item.message} [{item.code}]" for item in found)
