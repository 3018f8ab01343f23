# ament_cmake_ros: libraries are shared ones unless they say otherwise.

option(BUILD_SHARED_LIBS "Build shared libraries" ON)
