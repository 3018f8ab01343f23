"""``cartographer_ros``: its configuration files and the Lua that they are written in."""
