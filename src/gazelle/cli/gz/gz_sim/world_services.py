"""The services ``/world/NAME/…`` of the new Gazebo, by those that a world of Gazelle offers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from gazelle.cli.gz.gz_sim.message_types import message_of
from gazelle.cli.gz.options import GzError
from gazelle.cli.gz.world_link import WorldLink
from gazelle.cli.sdf.sdf_file import say
from gazelle.documents import read_text_limited
from gazelle.interfaces import message_type

__all__ = ["WORLD_SERVICES", "WorldService"]

_POSE = "geometry_msgs/msg/Pose"
_ENTITY = "ros_gz_interfaces/msg/Entity"
_LIGHT = 1


class WorldService(NamedTuple):
    """One service.

    Attributes:
        request: its type, without ``gz.msgs.``.
        call: does it; raises `GzError` when the world refuses.
    """

    request: str
    call: Callable[[WorldLink, Mapping[str, Any]], None]

    def check_type(self, given: str) -> None:
        """See that the type a user gave is the service's.

        Raises:
            GzError: it is another one.
        """
        if given and given.rpartition(".")[2] != self.request:
            raise GzError(f"the request is a gz.msgs.{self.request}, not a {given}")


def _control(link: WorldLink, fields: Mapping[str, Any]) -> None:
    unknown = {"seed", "run_to_sim_time"} & fields.keys()
    if unknown:
        raise GzError(f"{', '.join(sorted(unknown))} of WorldControl is not here")
    control = message_of("ros_gz_interfaces/msg/WorldControl", fields)
    if control.reset.time_only:
        raise GzError("time alone is not reset here; use reset: {all: true}")
    if (control.step or control.multi_step) and not control.pause:
        say(["gazelle: without pause: true the world runs on, in Gazebo too"])
    link.call("control_world", "ros_gz_interfaces/ControlWorld", world_control=control)


def _create(link: WorldLink, fields: Mapping[str, Any]) -> None:
    wanted = message_of("ros_gz_interfaces/msg/EntityFactory", fields)
    if wanted.clone_name:
        raise GzError("clone_name is not here; give sdf or sdf_filename")
    text = wanted.sdf or _read(wanted.sdf_filename)
    link.call(
        "spawn_sdf_model",
        "gazebo_msgs/SpawnModel",
        model_name=_free_name(link, wanted),
        model_xml=text,
        initial_pose=wanted.pose,
        reference_frame=wanted.relative_to,
    )


def _free_name(link: WorldLink, wanted: Any) -> str:
    """With ``allow_renaming`` a number goes behind a name that is taken, as in Gazebo."""
    taken = link.model_names() if wanted.allow_renaming and wanted.name else []
    name, count = str(wanted.name), 0
    while name in taken:
        count += 1
        name = f"{wanted.name}_{count}"
    return name


def _read(file: str) -> str:
    if not file:
        raise GzError("a model to create: sdf: '<sdf …>' or sdf_filename: 'FILE'")
    try:
        return read_text_limited(file)
    except (OSError, UnicodeDecodeError) as error:
        raise GzError(f"Unable to open file[{file}]: {error}") from None


def _remove(link: WorldLink, fields: Mapping[str, Any]) -> None:
    entity = message_of(_ENTITY, fields)
    if not entity.name:
        raise GzError("an entity is named here: name: 'box' type: MODEL; there are no ids")
    if entity.type == _LIGHT:
        link.call("delete_light", "gazebo_msgs/DeleteLight", light_name=entity.name)
        return
    link.check_model(entity.name)
    link.call("delete_model", "gazebo_msgs/DeleteModel", model_name=entity.name)


def _set_pose(link: WorldLink, fields: Mapping[str, Any]) -> None:
    name = str(fields.get("name", ""))
    if not name:
        raise GzError("a model is named here: name: 'box' position: {x: 1}; there are no ids")
    link.check_model(name)
    # A turn that is left out is none, as in Gazebo's message.
    pose = message_of(_POSE, {k: v for k, v in fields.items() if k not in {"name", "id"}})
    state = message_type("gazebo_msgs/ModelState")(model_name=name, pose=pose)
    link.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state)


WORLD_SERVICES: Mapping[str, WorldService] = {
    "control": WorldService("WorldControl", _control),
    "create": WorldService("EntityFactory", _create),
    "remove": WorldService("Entity", _remove),
    "set_pose": WorldService("Pose", _set_pose),
}
