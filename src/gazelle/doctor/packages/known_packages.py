"""Names of packages that come with ROS, so that a mistyped one is told from one not here."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import gazelle.interfaces

__all__ = ["is_ros_package", "known_packages"]

_NAMES = """
ackermann_steering_controller actionlib admittance_controller amcl ament_cmake ament_cmake_auto
ament_cmake_gtest ament_cmake_pytest ament_cmake_python ament_cmake_ros ament_copyright
ament_flake8 ament_index_cpp ament_index_python ament_lint_auto ament_lint_common ament_pep257
ament_python ament_xmllint angles base_local_planner camera_info_manager cartographer
cartographer_ros catkin class_loader cmake_modules control_msgs control_toolbox
controller_interface controller_manager costmap_2d cv_bridge depth_image_proc
depthimage_to_laserscan diagnostic_aggregator diagnostic_updater diff_drive_controller
dwa_local_planner dwb_core dynamic_reconfigure effort_controllers eigen ekf_localization
explore_lite fake_components filters force_torque_sensor_broadcaster forward_command_controller
frontier_exploration gazebo gazebo_dev gazebo_plugins gazebo_ros gazebo_ros2_control
gazebo_ros_control gazebo_ros_pkgs
geometric_shapes global_planner gmapping gripper_controllers gz_ros2_control hardware_interface
hector_gazebo_plugins hector_mapping hector_slam hls_lfcd_lds_driver ign_ros2_control
image_geometry image_proc image_transport imu_filter_madgwick imu_sensor_broadcaster
interactive_markers joint_limits_interface joint_state_broadcaster joint_state_controller
joint_state_publisher joint_state_publisher_gui joint_trajectory_controller joy joy_linux
joy_teleop kdl_parser laser_filters laser_geometry laser_proc launch launch_param_builder
launch_ros launch_testing launch_testing_ament_cmake launch_xml launch_yaml map_server mavros
message_filters message_generation message_runtime move_base moveit moveit_commander
moveit_configs_utils moveit_core moveit_fake_controller_manager moveit_kinematics moveit_planners
moveit_planners_chomp moveit_planners_ompl moveit_planners_stomp moveit_resources
moveit_resources_prbt_moveit_config moveit_ros moveit_ros_benchmarks moveit_ros_move_group
moveit_ros_planning moveit_ros_planning_interface moveit_ros_visualization moveit_ros_warehouse
moveit_servo moveit_setup_assistant moveit_simple_controller_manager moveit_visual_tools nav2_amcl
nav2_behavior_tree nav2_behaviors nav2_bringup nav2_bt_navigator nav2_collision_monitor
nav2_common nav2_controller nav2_core nav2_costmap_2d nav2_dwb_controller nav2_lifecycle_manager
nav2_loopback_sim nav2_map_server nav2_minimal_tb3_sim nav2_minimal_tb4_sim nav2_mppi_controller
nav2_msgs nav2_navfn_planner nav2_planner nav2_recoveries nav2_regulated_pure_pursuit_controller
nav2_rviz_plugins nav2_simple_commander nav2_smac_planner nav2_smoother nav2_theta_star_planner
nav2_util nav2_velocity_smoother nav2_waypoint_follower nav_core navfn navigation navigation2
nodelet opencv_bridge pcl_conversions pcl_ros pluginlib pointcloud_to_laserscan
position_controllers pr2_controller_manager python_qt_binding rclcpp rclcpp_action
rclcpp_components rclcpp_lifecycle rclpy realsense2_camera realsense2_description
resource_retriever rmw robot_localization robot_state_publisher ros2_control
ros2_control_test_assets ros2_controllers ros2bag ros2cli ros2launch ros2run ros2topic ros_gz
ros_gz_bridge ros_gz_image ros_gz_interfaces ros_gz_sim ros_ign ros_ign_bridge ros_ign_gazebo
ros_ign_image ros_ign_interfaces rosapi rosbag rosbash rosboost_cfg rosbridge_server roscpp
rosgraph_msgs rosidl_default_generators rosidl_default_runtime roslaunch roslib roslint rosnode
rospack rosparam rospy rosservice rostest rostopic rosunit rotate_recovery rplidar_ros rqt rqt_bag
rqt_common_plugins rqt_console rqt_controller_manager rqt_graph rqt_gui rqt_gui_py rqt_image_view
rqt_joint_trajectory_controller rqt_logger_level rqt_plot rqt_publisher rqt_reconfigure
rqt_robot_steering rqt_tf_tree rqt_topic rviz rviz2 rviz_common rviz_default_plugins
rviz_imu_plugin rviz_visual_tools sdformat_urdf sick_scan slam_gmapping slam_karto slam_toolbox
spacenav_node spawn_entity stage_ros teb_local_planner teleop_twist_joy teleop_twist_keyboard tf
tf2 tf2_eigen tf2_geometry_msgs tf2_kdl tf2_py tf2_ros tf2_sensor_msgs tf2_tools tf_conversions
topic_tools trac_ik_kinematics_plugin tracetools transmission_interface tricycle_controller
turtlesim twist_mux urdf urdf_parser_plugin urdfdom urdfdom_headers urg_node usb_cam v4l2_camera
velocity_controllers velodyne_description velodyne_gazebo_plugins velodyne_simulator vision_opencv
visp visualization warehouse_ros warehouse_ros_mongo warehouse_ros_sqlite web_video_server xacro
yaml_cpp_vendor
"""
_FAMILIES = ("ament_", "nav2_", "ros2", "rosidl_", "rqt_", "moveit_", "ros_gz", "ros_ign", "gz_")


@cache
def known_packages() -> frozenset[str]:
    """Return packages of ROS distributions, those of message types included."""
    definitions = Path(gazelle.interfaces.__file__).parent / "definitions"
    messages = {path.stem for path in definitions.rglob("*.txt")}
    return frozenset(_NAMES.split()) | messages


def is_ros_package(name: str) -> bool:
    """Tell whether a package comes with ROS."""
    return name in known_packages() or name.startswith(_FAMILIES)
