"""The process of a node in C++: what its runtime asks of Python, answered by the graph."""
