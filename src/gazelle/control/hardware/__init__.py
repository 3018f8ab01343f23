"""What controllers drive: simulated joints, actuators behind transmissions, sensors, mocks."""
