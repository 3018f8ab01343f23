"""Vectors, quaternions and transforms as arrays (ros_numpy.geometry).

A pose or transform is a homogeneous 4×4 matrix, a quaternion (x, y, z, w). An array of several
becomes an array of messages.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.compat.tf import transformations
from gazelle.interfaces import ros1_message_type

__all__ = [
    "numpy_to_point",
    "numpy_to_pose",
    "numpy_to_quat",
    "numpy_to_transform",
    "numpy_to_vector",
    "numpy_to_vector3",
    "point_to_numpy",
    "pose_to_numpy",
    "quat_to_numpy",
    "transform_to_numpy",
    "vector3_to_numpy",
]

Array = NDArray[np.float64]
_MATRIX = (4, 4)


def vector3_to_numpy(msg: Any, hom: bool = False) -> Array:
    """Return (x, y, z), with a fourth 0 if `hom`."""
    return np.array([msg.x, msg.y, msg.z, 0.0] if hom else [msg.x, msg.y, msg.z])


def point_to_numpy(msg: Any, hom: bool = False) -> Array:
    """Return (x, y, z), with a fourth 1 if `hom`."""
    return np.array([msg.x, msg.y, msg.z, 1.0] if hom else [msg.x, msg.y, msg.z])


def quat_to_numpy(msg: Any) -> Array:
    """Return (x, y, z, w)."""
    return np.array([msg.x, msg.y, msg.z, msg.w])


def pose_to_numpy(msg: Any) -> Array:
    """Return the homogeneous 4×4 matrix of a pose, m."""
    return _matrix(msg.position, msg.orientation)


def transform_to_numpy(msg: Any) -> Array:
    """Return the homogeneous 4×4 matrix of a transform, m."""
    return _matrix(msg.translation, msg.rotation)


def numpy_to_vector(arr: ArrayLike, *, msg_type: Any) -> Any:
    """Return the vector or point of an array of shape (…, 3) or, homogeneous, (…, 4).

    Raises:
        ValueError: it has another number of values, or a direction's fourth is not 0.
    """
    rows = np.asarray(arr, float)
    if rows.ndim == 0 or rows.shape[-1] not in (3, 4):
        raise ValueError(f"a vector has 3 or 4 values, this array is of shape {rows.shape}")
    if rows.shape[-1] == 4:
        is_point = msg_type.TYPE_NAME == "geometry_msgs/msg/Point"
        if not is_point and np.any(rows[..., 3]):
            raise ValueError("the fourth value of a homogeneous vector is 0; this is a point")
        rows = rows[..., :3] / rows[..., 3:] if is_point else rows[..., :3]
    return _each(rows, 1, lambda row: msg_type(*map(float, row)))


def numpy_to_vector3(arr: ArrayLike) -> Any:
    """Return the ``Vector3`` of an array of shape (…, 3) or, homogeneous, (…, 4)."""
    return numpy_to_vector(arr, msg_type=ros1_message_type("geometry_msgs/Vector3"))


def numpy_to_point(arr: ArrayLike) -> Any:
    """Return the ``Point`` of an array of shape (…, 3) or, homogeneous, (…, 4)."""
    return numpy_to_vector(arr, msg_type=ros1_message_type("geometry_msgs/Point"))


def numpy_to_quat(arr: ArrayLike, *, msg_type: Any = None) -> Any:
    """Return the quaternion of an array (x, y, z, w).

    Raises:
        ValueError: it has not 4 values.
    """
    rows = np.asarray(arr, float)
    if rows.ndim == 0 or rows.shape[-1] != 4:
        raise ValueError(f"a quaternion has 4 values, this array is of shape {rows.shape}")
    make = msg_type or ros1_message_type("geometry_msgs/Quaternion")
    return _each(rows, 1, lambda row: make(*map(float, row)))


def numpy_to_pose(arr: ArrayLike, *, msg_type: Any = None) -> Any:
    """Return the pose of a matrix.

    Raises:
        ValueError: it is not 4×4.
    """
    return _from_matrix(arr, msg_type or ros1_message_type("geometry_msgs/Pose"))


def numpy_to_transform(arr: ArrayLike, *, msg_type: Any = None) -> Any:
    """Return the transform of a matrix.

    Raises:
        ValueError: it is not 4×4.
    """
    return _from_matrix(arr, msg_type or ros1_message_type("geometry_msgs/Transform"))


def _matrix(translation: Any, rotation: Any) -> Array:
    matrix = transformations.quaternion_matrix(quat_to_numpy(rotation))
    matrix[:3, 3] = vector3_to_numpy(translation)
    return matrix


def _from_matrix(arr: ArrayLike, make: Any) -> Any:
    matrices = np.asarray(arr, float)
    if matrices.shape[-2:] != _MATRIX:
        raise ValueError(f"a pose is a 4×4 matrix, this array is of shape {matrices.shape}")

    def convert(matrix: Array) -> Any:
        made = make()
        translation, rotation = (getattr(made, item.name) for item in make.FIELDS)
        translation.x, translation.y, translation.z = map(
            float, transformations.translation_from_matrix(matrix)
        )
        rotation.x, rotation.y, rotation.z, rotation.w = map(
            float, transformations.quaternion_from_matrix(matrix)
        )
        return made

    return _each(matrices, 2, convert)


def _each(values: Array, n_own: int, convert: Callable[[Array], Any]) -> Any:
    """Convert an array whose last `n_own` axes make one message."""
    shape = values.shape[: values.ndim - n_own]
    if not shape:
        return convert(values)
    found = np.empty(shape, object)
    for index in np.ndindex(shape):
        found[index] = convert(values[index])
    return found
