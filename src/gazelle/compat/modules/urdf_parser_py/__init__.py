"""urdf_parser_py, by Gazelle."""
