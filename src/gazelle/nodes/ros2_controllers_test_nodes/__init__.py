"""``ros2_controllers_test_nodes``: one goal after another for a controller, for ever."""
