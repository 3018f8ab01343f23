"""Gazebo's plug-ins, one module a family; `registry` knows which name means which."""
