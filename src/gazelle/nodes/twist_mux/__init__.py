"""``twist_mux``: one of several velocity commands, by priorities, time-outs and locks."""
