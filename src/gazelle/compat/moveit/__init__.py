"""What MoveIt's Python modules share: a client of move_group and the robot it is for."""

from __future__ import annotations
