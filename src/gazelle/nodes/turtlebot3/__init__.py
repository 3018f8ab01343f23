"""TurtleBot3's own programs: the fake robot, the wanderer, the flat IMU, the keyboard."""
