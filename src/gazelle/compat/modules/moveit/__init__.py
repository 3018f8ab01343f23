"""moveit_py, on Gazelle's graph."""
