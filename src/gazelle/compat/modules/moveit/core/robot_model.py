"""moveit.core.robot_model, on Gazelle's motion."""

from gazelle.compat.moveit.py.robot import JointModelGroup, RobotModel
