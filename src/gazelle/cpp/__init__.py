"""C++ packages: compiled on the user's machine, run as shared libraries in processes of ours."""
