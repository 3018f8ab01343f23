"""Nav2 from Python, as nav2_simple_commander."""
