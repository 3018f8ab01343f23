"""moveit.core.robot_state, on Gazelle's motion."""

from gazelle.compat.moveit.py.robot import RobotState
