"""``view_frames`` and ``tf_monitor``: the tree of frames, drawn and timed."""
