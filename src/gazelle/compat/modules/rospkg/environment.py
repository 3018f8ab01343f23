"""rospkg.environment, by Gazelle."""

from gazelle.compat.rospkg import *  # noqa: F403

ROS_ETC_DIR = "ROS_ETC_DIR"
ROS_HOME = "ROS_HOME"
ROS_LOG_DIR = "ROS_LOG_DIR"
ROS_PACKAGE_PATH = "ROS_PACKAGE_PATH"
ROS_ROOT = "ROS_ROOT"
ROS_TEST_RESULTS_DIR = "ROS_TEST_RESULTS_DIR"
