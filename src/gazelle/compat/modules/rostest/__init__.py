"""rostest."""

from gazelle.compat.unit_tests import rosrun
from gazelle.compat.unit_tests import unitrun as unitrun

run = rosrun

__all__ = ["rosrun", "run", "unitrun"]
