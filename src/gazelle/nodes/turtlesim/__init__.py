"""turtlesim: the turtle, its keyboard, ``mimic`` and ``draw_square``, without a window."""
