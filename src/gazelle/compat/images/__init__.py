"""Images in users' programs: cv_bridge, with OpenCV where it is installed and without."""
