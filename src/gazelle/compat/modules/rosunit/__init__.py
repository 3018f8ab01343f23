"""rosunit: tests without a graph, written as JUnit XML."""

from gazelle.compat.rostest import unitrun

__all__ = ["unitrun"]
