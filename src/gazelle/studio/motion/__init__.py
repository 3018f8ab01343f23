"""MoveIt's view: the robot as move_group sees it, its planning scene and planned paths."""
