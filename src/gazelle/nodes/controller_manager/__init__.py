"""``controller_manager``: its spawners, its command and ``ros2_control_node``."""
