"""Nav2's servers: planning, control, behaviours, behaviour trees, waypoints, lifecycle."""
