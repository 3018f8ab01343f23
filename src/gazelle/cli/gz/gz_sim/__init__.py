"""``gz sim``, ``topic``, ``service`` and ``model`` of the new Gazebo (Fortress to Harmonic)."""
