"""PlanningSceneInterface: objects around the robot and on it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.commander.roscpp_initializer import client_of, ros1
from gazelle.geometry import MeshError, load_mesh
from gazelle.interfaces import convert, fill, message_type, ros1_message_type, service_type

__all__ = ["PlanningSceneInterface"]

_ADD, _REMOVE = 0, 1
_BOX, _SPHERE, _CYLINDER, _CONE = 1, 2, 3, 4
_NAMES, _GEOMETRY, _ATTACHED = 8, 16, 4


class PlanningSceneInterface:
    """Adds, attaches, lists and removes objects; each call returns when move_group knows of it.

    Args:
        ns: namespace of move_group.
        synchronous: without effect: what is asked for at leisure is there at once as well.
        service_timeout: without effect: who is not answered hears of it in any case.
    """

    def __init__(
        self, ns: str = "", synchronous: bool = True, service_timeout: float = 5.0
    ) -> None:
        self._client = client_of(ns)

    def add_object(self, collision_object: Any) -> None:
        """Add a ``CollisionObject``."""
        self._submit([collision_object])

    def add_sphere(self, name: str, pose: Any, radius: float = 1.0) -> None:
        """Add a sphere at a ``PoseStamped``; lengths in m."""
        self._submit([self.make_sphere(name, pose, radius)])

    def add_cylinder(self, name: str, pose: Any, height: float, radius: float) -> None:
        """Add a cylinder."""
        self._submit([self.make_cylinder(name, pose, height, radius)])

    def add_cone(self, name: str, pose: Any, height: float, radius: float) -> None:
        """Add a cone."""
        self._submit([self.make_cone(name, pose, height, radius)])

    def add_box(self, name: str, pose: Any, size: Sequence[float] = (1, 1, 1)) -> None:
        """Add a box."""
        self._submit([self.make_box(name, pose, size)])

    def add_mesh(
        self, name: str, pose: Any, filename: str, size: Sequence[float] = (1, 1, 1)
    ) -> None:
        """Add a mesh file, scaled by three factors.

        Raises:
            MoveItCommanderException: the file cannot be read.
        """
        self._submit([self.make_mesh(name, pose, filename, size)])

    def add_plane(
        self, name: str, pose: Any, normal: Sequence[float] = (0, 0, 1), offset: float = 0
    ) -> None:
        """Add a plane."""
        self._submit([self.make_plane(name, pose, normal, offset)])

    def attach_object(
        self, attached_collision_object: Any, link: Any = None, touch_links: Any = None
    ) -> None:
        """Attach an ``AttachedCollisionObject``, or a ``CollisionObject`` or name to a link."""
        kind = ros1_message_type("moveit_msgs/AttachedCollisionObject")
        found = attached_collision_object
        if not hasattr(found, "touch_links"):
            item = found if hasattr(found, "id") else _empty(str(found))
            found = kind(link_name=link, object=item, touch_links=list(touch_links or ()))
        self._submit([], [found])

    def attach_box(
        self,
        link: str,
        name: str,
        pose: Any = None,
        size: Sequence[float] = (1, 1, 1),
        touch_links: Sequence[str] = (),
    ) -> None:
        """Attach a box; without a pose an object of that name, as it is in the scene."""
        item = None if pose is None else self.make_box(name, pose, size)
        self.attach_object(item or name, link, touch_links)

    def attach_sphere(
        self,
        link: str,
        name: str,
        pose: Any = None,
        radius: float = 1.0,
        touch_links: Sequence[str] = (),
    ) -> None:
        """Attach a sphere; without a pose an object of that name, as it is in the scene."""
        item = None if pose is None else self.make_sphere(name, pose, radius)
        self.attach_object(item or name, link, touch_links)

    def attach_mesh(
        self,
        link: str,
        name: str,
        pose: Any = None,
        filename: str = "",
        size: Sequence[float] = (1, 1, 1),
        touch_links: Sequence[str] = (),
    ) -> None:
        """Attach a mesh file; without a pose an object of that name, as it is in the scene."""
        item = None if pose is None else self.make_mesh(name, pose, filename, size)
        self.attach_object(item or name, link, touch_links)

    def remove_world_object(self, name: str | None = None) -> None:
        """Remove an object that is not attached, all of them without a name."""
        item = _empty(name or "")
        item.operation = _REMOVE
        self._submit([item])

    def remove_attached_object(self, link: str | None = None, name: str | None = None) -> None:
        """Let an object of a link go, all of them without a name; it stays in the world."""
        item: Any = ros1_message_type("moveit_msgs/AttachedCollisionObject")()
        item.link_name, item.object.id = link or "", name or ""
        item.object.operation = _REMOVE
        self._submit([], [item])

    def clear(self) -> None:
        """Remove all objects, attached ones too."""
        self.remove_attached_object()
        self.remove_world_object()

    def get_known_object_names(self, with_type: bool = False) -> list[str]:
        """Return the names of objects that are not attached."""
        found = self._scene(_NAMES).world.collision_objects
        return [item.id for item in found if item.type.key or not with_type]

    def get_known_object_names_in_roi(
        self,
        minx: float,
        miny: float,
        minz: float,
        maxx: float,
        maxy: float,
        maxz: float,
        with_type: bool = False,
    ) -> list[str]:
        """Return the names of objects whose position is within a box of the planning frame, m."""
        found = []
        for item in self._scene(_NAMES | _GEOMETRY).world.collision_objects:
            position = item.pose.position
            inside = (
                minx <= position.x <= maxx
                and miny <= position.y <= maxy
                and minz <= position.z <= maxz
            )
            if inside and (item.type.key or not with_type):
                found.append(item.id)
        return found

    def get_object_poses(self, object_ids: Sequence[str]) -> dict[str, Any]:
        """Return the poses of objects in the planning frame, by name."""
        found = self.get_objects(object_ids)
        return {name: item.pose for name, item in found.items()}

    def get_objects(self, object_ids: Sequence[str] = ()) -> dict[str, Any]:
        """Return ``CollisionObject`` by name, all of them when none are named."""
        found = self._scene(_NAMES | _GEOMETRY).world.collision_objects
        return {item.id: ros1(item) for item in found if not object_ids or item.id in object_ids}

    def get_attached_objects(self, object_ids: Sequence[str] = ()) -> dict[str, Any]:
        """Return ``AttachedCollisionObject`` by name, all of them when none are named."""
        found = self._scene(_ATTACHED).robot_state.attached_collision_objects
        wanted = set(object_ids)
        return {one.object.id: ros1(one) for one in found if not wanted or one.object.id in wanted}

    def get_planning_scene(self, components: int) -> Any:
        """Return parts of the scene as ``PlanningScene``."""
        return ros1(self._scene(components))

    def apply_planning_scene(self, planning_scene_message: Any) -> bool:
        """Apply a ``PlanningScene``; tells whether all of it could be done."""
        scene = convert(planning_scene_message, message_type("moveit_msgs/msg/PlanningScene"))
        return self._apply(scene)

    @staticmethod
    def make_box(name: str, pose: Any, size: Sequence[float]) -> Any:
        """Return the ``CollisionObject`` of a box."""
        return _primitive(name, pose, _BOX, [float(value) for value in size])

    @staticmethod
    def make_sphere(name: str, pose: Any, radius: float) -> Any:
        """Return the ``CollisionObject`` of a sphere."""
        return _primitive(name, pose, _SPHERE, [float(radius)])

    @staticmethod
    def make_cylinder(name: str, pose: Any, height: float, radius: float) -> Any:
        """Return the ``CollisionObject`` of a cylinder."""
        return _primitive(name, pose, _CYLINDER, [float(height), float(radius)])

    @staticmethod
    def make_cone(name: str, pose: Any, height: float, radius: float) -> Any:
        """Return the ``CollisionObject`` of a cone."""
        return _primitive(name, pose, _CONE, [float(height), float(radius)])

    @staticmethod
    def make_plane(
        name: str, pose: Any, normal: Sequence[float] = (0, 0, 1), offset: float = 0
    ) -> Any:
        """Return the ``CollisionObject`` of a plane."""
        item = _empty(name, pose)
        coef = [*(float(value) for value in normal), float(offset)]
        item.planes = [ros1_message_type("shape_msgs/Plane")(coef=coef)]
        item.plane_poses = [pose.pose]
        return item

    @staticmethod
    def make_mesh(name: str, pose: Any, filename: str, scale: Sequence[float] = (1, 1, 1)) -> Any:
        """Return the ``CollisionObject`` of a mesh file.

        Raises:
            MoveItCommanderException: the file cannot be read.
        """
        try:
            mesh = load_mesh(Path(filename))
        except (MeshError, OSError) as error:
            raise MoveItCommanderException(f"cannot read mesh '{filename}': {error}") from error
        item = _empty(name, pose)
        shape: Any = ros1_message_type("shape_msgs/Mesh")()
        vertices = mesh.vertices_m * [float(value) for value in scale]
        rows = [dict(zip("xyz", row, strict=True)) for row in vertices.tolist()]
        triangles = [{"vertex_indices": row} for row in mesh.faces.tolist()]
        fill(shape, {"vertices": rows, "triangles": triangles})
        item.meshes, item.mesh_poses = [shape], [pose.pose]
        return item

    def _submit(self, objects: Sequence[Any], attached: Sequence[Any] = ()) -> None:
        scene: Any = message_type("moveit_msgs/msg/PlanningScene")(is_diff=True)
        scene.robot_state.is_diff = True
        kind = message_type("moveit_msgs/msg/CollisionObject")
        scene.world.collision_objects = [convert(item, kind) for item in objects]
        kind = message_type("moveit_msgs/msg/AttachedCollisionObject")
        scene.robot_state.attached_collision_objects = [convert(item, kind) for item in attached]
        self._apply(scene)

    def _apply(self, scene: Any) -> bool:
        request = service_type("moveit_msgs/ApplyPlanningScene").Request(scene=scene)
        return bool(
            self._client.call("apply_planning_scene", "ApplyPlanningScene", request).success
        )

    def _scene(self, parts: int) -> Any:
        fields = {"components": {"components": parts}}
        return self._client.call("get_planning_scene", "GetPlanningScene", **fields).scene


def _empty(name: str, pose: Any = None) -> Any:
    made: Any = ros1_message_type("moveit_msgs/CollisionObject")(id=name)
    made.operation = _ADD
    if pose is not None:
        made.header = pose.header
    return made


def _primitive(name: str, pose: Any, kind: int, dimensions: list[float]) -> Any:
    made = _empty(name, pose)
    shape = ros1_message_type("shape_msgs/SolidPrimitive")
    made.primitives = [shape(type=kind, dimensions=dimensions)]
    made.primitive_poses = [pose.pose]
    return made
