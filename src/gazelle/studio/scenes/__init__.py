"""Robot descriptions → scene values, and the meshes and textures they name."""
