"""What `urdf_parser_py` is in Gazelle: URDF as Python objects, and the reflection they use."""
