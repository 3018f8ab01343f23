"""``gz topic``, ``model``, ``world``, ``stats`` and ``joint`` of Gazebo 11, over the graph."""
