# What find_package finds: Gazelle's own packages, then those of the workspace, then the system's.

cmake_policy(PUSH)
cmake_policy(VERSION 3.5...3.31)

set(GAZELLE_CMAKE_FOLDER "${CMAKE_CURRENT_LIST_DIR}")
include("${GAZELLE_SETTINGS}")

set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/.." "$ORIGIN/../lib")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
set(CMAKE_INSTALL_MESSAGE LAZY)
# A test is built and run by the real build tools only.
set(BUILD_TESTING OFF CACHE BOOL "" FORCE)
set(CATKIN_ENABLE_TESTING OFF CACHE BOOL "" FORCE)
set(CATKIN_SKIP_TESTING ON CACHE BOOL "" FORCE)

include("${GAZELLE_CMAKE_FOLDER}/targets.cmake")
include("${GAZELLE_CMAKE_FOLDER}/finish.cmake")

# Called by CMake for every find_package; leaves <name>_FOUND alone where the package is not ours.
macro(gazelle_find_package method name)
  cmake_policy(PUSH)
  cmake_policy(VERSION 3.5...3.31)
  gazelle_find("${name}" "${ARGN}")
  cmake_policy(POP)
endmacro()

# A macro: what it finds are variables of whoever asked.
macro(gazelle_find name words)
  if("${name}" STREQUAL "catkin" AND GAZELLE_ROS EQUAL 1)
    gazelle_load(catkin)
    gazelle_find_catkin(${words})
  elseif("${name}" STREQUAL "Boost" AND GAZELLE_OWN_BOOST)
    gazelle_find_boost(${words})
  elseif(("${name}" STREQUAL "Eigen" OR "${name}" STREQUAL "Eigen3") AND GAZELLE_EIGEN_DIR)
    gazelle_find_eigen("${name}")
  elseif(DEFINED GAZELLE_EXPORT_${name})
    include("${GAZELLE_EXPORT_${name}}")
  elseif("${name}" IN_LIST GAZELLE_PROVIDED)
    gazelle_provide("${name}")
  else()
    gazelle_why_refused("${name}" gazelle_why)
    if(gazelle_why)
      gazelle_refuse("${name}" "${gazelle_why}")
    else()
      gazelle_hide_other_ros("${name}")
    endif()
  endif()
endmacro()

# Keep a package of a ROS that is installed on this system out: its libraries and ours do not mix.
macro(gazelle_hide_other_ros name)
  file(GLOB gazelle_others "/opt/ros/*")
  foreach(gazelle_prefix IN ITEMS /usr /usr/local ${gazelle_others})
    if(EXISTS "${gazelle_prefix}/share/${name}/package.xml")
      list(APPEND CMAKE_IGNORE_PATH "${gazelle_prefix}/share/${name}/cmake")
    endif()
  endforeach()
endmacro()

cmake_language(SET_DEPENDENCY_PROVIDER gazelle_find_package SUPPORTED_METHODS FIND_PACKAGE)

if(GAZELLE_ROS EQUAL 1)
  add_definitions(-DROS_BUILD_SHARED_LIBS=1)
endif()
cmake_policy(POP)
