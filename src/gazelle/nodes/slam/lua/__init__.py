"""Cartographer's configuration files: the Lua that they are written in, and what they say."""
