"""The half of the bridge that runs in ROS's own Python, where Gazelle is not installed.

`run.py` is started by its path. Nothing here imports Gazelle; the other half imports `pipes`.
Works with every ``rclpy`` from Humble on (Python 3.10).
"""
