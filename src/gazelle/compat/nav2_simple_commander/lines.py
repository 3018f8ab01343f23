"""The points of a line, one step after another."""

from __future__ import annotations

import math

__all__ = ["LineIterator"]

_DIGITS = 5


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
