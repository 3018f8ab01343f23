"""Maps as arrays (ros_numpy.occupancy_grid)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.interfaces import ros1_message_type

__all__ = ["numpy_to_occupancy_grid", "occupancygrid_to_numpy"]

_UNKNOWN = -1


def occupancygrid_to_numpy(msg: Any) -> np.ma.MaskedArray[Any, Any]:
    """Return a map's cells, rows first; unknown ones are masked."""
    size = (int(msg.info.height), int(msg.info.width))
    data = np.asarray(msg.data, np.int8).reshape(size)
    made: np.ma.MaskedArray[Any, Any] = np.ma.array(
        data, mask=data == _UNKNOWN, fill_value=_UNKNOWN
    )
    return made


def numpy_to_occupancy_grid(arr: NDArray[Any], info: Any = None, *, msg_type: Any = None) -> Any:
    """Return the map of an array of cells.

    Args:
        arr: int8 of shape (height, width); masked cells become unknown.
        info: ``MapMetaData``, whose size is set.
        msg_type: class of the map.

    Raises:
        TypeError: it has not two axes, or holds other numbers.
    """
    if arr.ndim != 2:
        raise TypeError(f"Array must be 2D, this one is of shape {arr.shape}")
    if arr.dtype != np.int8:
        raise TypeError(f"Array must be of int8s, this one is of {arr.dtype}")
    if isinstance(arr, np.ma.MaskedArray):
        arr = arr.filled(_UNKNOWN)
    grid = (msg_type or ros1_message_type("nav_msgs/OccupancyGrid"))()
    if info is not None:
        grid.info = info
    grid.info.height, grid.info.width = arr.shape
    grid.data = arr.ravel().tolist()
    return grid
