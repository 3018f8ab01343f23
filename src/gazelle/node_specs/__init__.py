"""What each built-in node is, one row for each: names, function, topics, services, actions, tf.

Rows of plain data. A node's function is named by text and imported when the node is started, so
that whoever looks up names, topics or packages loads no node.
"""
