"""``robot_localization`` and ``robot_pose_ekf``: Kalman filters of odometry and IMU."""
