"""rostest: tests as nodes, written as JUnit XML."""

from gazelle.compat.rostest import *  # noqa: F403
