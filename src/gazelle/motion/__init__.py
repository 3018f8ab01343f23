"""Arms: inverse kinematics, collision checking, motion planning, time parameterisation."""
