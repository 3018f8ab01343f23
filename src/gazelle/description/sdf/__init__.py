"""SDF 1.4 to 1.12: worlds, models and their parts."""
