"""``gz sdf`` of Gazebo 11 and ``ign sdf`` of Fortress: SDF files printed, checked, drawn."""
