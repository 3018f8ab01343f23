"""``topic_tools``: nodes that pass on, choose and change topics of any type."""
