"""``nav2_msgs/Costmap`` as a grid of costs, the points of a line, and what a footprint costs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.interfaces import message_type

__all__ = [
    "FREE_SPACE",
    "INSCRIBED_INFLATED_OBSTACLE",
    "LETHAL_OBSTACLE",
    "MAX_NON_OBSTACLE",
    "NO_INFORMATION",
    "FootprintCollisionChecker",
    "LineIterator",
    "PyCostmap2D",
]

_DIGITS = 5
NO_INFORMATION = 255
LETHAL_OBSTACLE = 254
INSCRIBED_INFLATED_OBSTACLE = 253
MAX_NON_OBSTACLE = 252
FREE_SPACE = 0


class LineIterator:
    """Walks from one point to another: along x, and along y only where the line is upright.

    Args:
        x0: where it begins.
        y0: the same.
        x1: where it ends.
        y1: the same.
        step_size: how far a step goes along that axis.

    Raises:
        TypeError: one of them is no number.
        ValueError: the step is not positive, or the line has no length.
    """

    def __init__(self, x0: float, y0: float, x1: float, y1: float, step_size: float = 1.0) -> None:
        given = {"x0": x0, "y0": y0, "x1": x1, "y1": y1, "step_size": step_size}
        for name, value in given.items():
            if not isinstance(value, (int, float)) or isinstance(value, bool):
                raise TypeError(f"{name} must be a number (int or float)")
        if step_size <= 0:
            raise ValueError("step_size must be a positive number")
        if (x0, y0) == (x1, y1):
            raise ValueError("Line has zero length (All 4 points have same coordinates)")
        self.x0_, self.y0_, self.x1_, self.y1_ = x0, y0, x1, y1
        self.x_, self.y_ = x0, y0
        self.step_size_ = step_size
        self.valid_ = True

    def isValid(self) -> bool:
        """Tell whether there is a point."""
        return self.valid_

    def advance(self) -> None:
        """Go on to the next point; after the last there is none."""
        if (self.x_, self.y_) == (self.x1_, self.y1_):
            self.valid_ = False
        elif self.x0_ == self.x1_:
            self.y_ = self._next(self.y_, self.y0_, self.y1_)
        else:
            self.x_ = self._next(self.x_, self.x0_, self.x1_)
            slope = (self.y1_ - self.y0_) / (self.x1_ - self.x0_)
            self.y_ = round(self.y1_ + slope * (self.x_ - self.x1_), _DIGITS)
            if self.x_ == self.x1_:
                self.y_ = self.y1_

    def _next(self, now: float, begin: float, end: float) -> float:
        step = math.copysign(self.step_size_, end - begin)
        reached = round(self.clamp(now + step, min(begin, end), max(begin, end)), _DIGITS)
        return end if abs(end - reached) < 0.5 * 10**-_DIGITS else reached

    def getX(self) -> float:
        """Return the point's x."""
        return self.x_

    def getY(self) -> float:
        """Return the point's y."""
        return self.y_

    def getX0(self) -> float:
        """Return the first point's x."""
        return self.x0_

    def getY0(self) -> float:
        """Return the first point's y."""
        return self.y0_

    def getX1(self) -> float:
        """Return the last point's x."""
        return self.x1_

    def getY1(self) -> float:
        """Return the last point's y."""
        return self.y1_

    def get_line_length(self) -> float:
        """Return the length."""
        return math.hypot(self.x1_ - self.x0_, self.y1_ - self.y0_)

    def clamp(self, n: float, min_n: float, max_n: float) -> float:
        """Return a number kept between two others."""
        return min(max(n, min_n), max_n)


class PyCostmap2D:
    """A costmap as Nav2 publishes it; cells are counted from its corner.

    Args:
        occupancy_map: the ``nav2_msgs/Costmap``.
    """

    def __init__(self, occupancy_map: Any) -> None:
        about = occupancy_map.metadata
        self.size_x: int = about.size_x
        self.size_y: int = about.size_y
        self.resolution: float = about.resolution
        self.origin_x: float = about.origin.position.x
        self.origin_y: float = about.origin.position.y
        self.global_frame_id: str = occupancy_map.header.frame_id
        self.costmap_timestamp = occupancy_map.header.stamp
        self.costmap = np.array(occupancy_map.data, dtype=np.uint8)

    def getSizeInCellsX(self) -> int:
        """Return the width in cells."""
        return self.size_x

    def getSizeInCellsY(self) -> int:
        """Return the height in cells."""
        return self.size_y

    def getSizeInMetersX(self) -> float:
        """Return the width in metres."""
        return self.size_x * self.resolution

    def getSizeInMetersY(self) -> float:
        """Return the height in metres."""
        return self.size_y * self.resolution

    def getOriginX(self) -> float:
        """Return the corner's x in metres."""
        return self.origin_x

    def getOriginY(self) -> float:
        """Return the corner's y in metres."""
        return self.origin_y

    def getResolution(self) -> float:
        """Return the edge of a cell in metres."""
        return self.resolution

    def getGlobalFrameID(self) -> str:
        """Return the frame of the map."""
        return self.global_frame_id

    def getCostmapTimestamp(self) -> Any:
        """Return when the map was made."""
        return self.costmap_timestamp

    def getCostXY(self, mx: int, my: int) -> np.uint8:
        """Return a cell's cost."""
        return self.getCostIdx(self.getIndex(mx, my))

    def getCostIdx(self, index: int) -> np.uint8:
        """Return the cost at an index."""
        return np.uint8(self.costmap[index])

    def setCost(self, mx: int, my: int, cost: int) -> None:
        """Set a cell's cost."""
        self.costmap[self.getIndex(mx, my)] = cost

    def mapToWorld(self, mx: int, my: int) -> tuple[float, float]:
        """Return the middle of a cell in metres."""
        wx = self.origin_x + (mx + 0.5) * self.resolution
        return wx, self.origin_y + (my + 0.5) * self.resolution

    def worldToMap(self, wx: float, wy: float) -> tuple[int, int]:
        """Return the cell of a point, on the map or not."""
        mx = int((wx - self.origin_x) // self.resolution)
        return mx, int((wy - self.origin_y) // self.resolution)

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int, int] | tuple[None, None]:
        """Return the cell of a point, twice None off the map."""
        mx, my = self.worldToMap(wx, wy)
        is_on = 0 <= mx < self.size_x and 0 <= my < self.size_y
        return (mx, my) if is_on else (None, None)

    def getIndex(self, mx: int, my: int) -> int:
        """Return the index of a cell."""
        return my * self.size_x + mx


class FootprintCollisionChecker:
    """Tells the highest cost below a footprint's edges."""

    def __init__(self) -> None:
        self.costmap_: PyCostmap2D | None = None

    def setCostmap(self, costmap: PyCostmap2D) -> None:
        """Say which costmap is looked at."""
        self.costmap_ = costmap

    def _costmap(self) -> PyCostmap2D:
        if self.costmap_ is None:
            raise ValueError("Costmap not specified, use setCostmap to specify the costmap first")
        return self.costmap_

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int, int] | tuple[None, None]:
        """Return the cell of a point, twice None off the map."""
        return self._costmap().worldToMapValidated(wx, wy)

    def pointCost(self, x: int, y: int) -> np.uint8:
        """Return a cell's cost."""
        return self._costmap().getCostXY(x, y)

    def lineCost(self, x0: float, x1: float, y0: float, y1: float, step_size: float = 0.5) -> float:
        """Return the highest cost between two cells, as soon as it is an obstacle."""
        highest = 0.0
        line = LineIterator(x0, y0, x1, y1, step_size)
        while line.isValid() and highest != LETHAL_OBSTACLE:
            cost = float(self.pointCost(int(line.getX()), int(line.getY())))
            highest = LETHAL_OBSTACLE if cost == LETHAL_OBSTACLE else max(highest, cost)
            line.advance()
        return highest

    def footprintCost(self, footprint: Any) -> float:
        """Return the highest cost of a polygon's edges; off the map is an obstacle.

        Args:
            footprint: a ``geometry_msgs/Polygon`` in the map's frame.
        """
        cells = [self.worldToMapValidated(point.x, point.y) for point in footprint.points]
        highest = 0.0
        for (x0, y0), (x1, y1) in zip(cells, [*cells[1:], cells[0]], strict=True):
            if x0 is None or y0 is None or x1 is None or y1 is None:
                return LETHAL_OBSTACLE
            if (x0, y0) == (x1, y1):
                cost = float(self.pointCost(x0, y0))
            else:
                cost = self.lineCost(x0, x1, y0, y1)
            if cost == LETHAL_OBSTACLE:
                return LETHAL_OBSTACLE
            highest = max(cost, highest)
        return highest

    def footprintCostAtPose(self, x: float, y: float, theta: float, footprint: Any) -> float:
        """Return what a footprint costs where a robot stands.

        Args:
            x: the robot's place in metres.
            y: the same.
            theta: how it is turned, in radians.
            footprint: a ``geometry_msgs/Polygon`` in the robot's frame.
        """
        turned = message_type("geometry_msgs/Polygon")()
        make = message_type("geometry_msgs/Point32")
        cos, sin = math.cos(theta), math.sin(theta)
        for point in footprint.points:
            placed = make()
            placed.x = x + point.x * cos - point.y * sin
            placed.y = y + point.x * sin + point.y * cos
            turned.points.append(placed)
        return self.footprintCost(turned)
