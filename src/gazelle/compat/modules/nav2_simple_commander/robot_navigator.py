"""Drop-in for nav2_simple_commander.robot_navigator."""

from gazelle.compat.navigation.navigator import BasicNavigator, TaskResult

__all__ = ["BasicNavigator", "TaskResult"]
