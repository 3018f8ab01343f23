"""genpy.rostime."""

from gazelle.interfaces import Duration, Time, TVal

__all__ = ["Duration", "TVal", "Time"]
