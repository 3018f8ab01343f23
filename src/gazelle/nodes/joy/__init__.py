"""``joy``: a joystick of the Linux kernel as messages."""
