"""Drop-in for nav2_simple_commander.robot_navigator."""

from gazelle.compat.nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult

__all__ = ["BasicNavigator", "TaskResult"]
