"""What people keep of their views: ``.rviz`` files, rqt's perspectives, layouts of the page."""
