"""What `rosgraph` is in Gazelle: a master's answers from the graph, its address, and names."""
