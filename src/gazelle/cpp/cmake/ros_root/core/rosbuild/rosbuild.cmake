# What `include($ENV{ROS_ROOT}/core/rosbuild/rosbuild.cmake)` brings.
include("${CMAKE_CURRENT_LIST_DIR}/../../../rosbuild.cmake")
