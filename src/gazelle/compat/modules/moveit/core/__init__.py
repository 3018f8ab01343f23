"""moveit.core, on Gazelle's motion."""
