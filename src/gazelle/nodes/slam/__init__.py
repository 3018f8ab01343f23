"""SLAM nodes under the names of gmapping, karto, hector, cartographer and slam_toolbox."""
