"""Wheeled bases: kinematics, odometry, speed limits, and what their controllers share."""
