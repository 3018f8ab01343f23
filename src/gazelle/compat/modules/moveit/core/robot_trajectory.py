"""moveit.core.robot_trajectory, on Gazelle's motion."""

from gazelle.compat.moveit.py.robot import RobotTrajectory
