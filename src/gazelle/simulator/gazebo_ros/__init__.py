"""What `gazebo_ros` offers: topics, services and parameters under ``/gazebo``."""
