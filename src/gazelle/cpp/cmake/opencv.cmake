# The system's OpenCV, which cv_bridge's and image_geometry's headers are written over.

macro(gazelle_with_opencv name)
  find_package(OpenCV QUIET COMPONENTS core imgproc imgcodecs calib3d)
  if(OpenCV_FOUND)
    list(APPEND ${name}_LIBRARIES ${OpenCV_LIBS})
    list(APPEND ${name}_INCLUDE_DIRS ${OpenCV_INCLUDE_DIRS})
    set_property(TARGET "${name}::${name}" APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${OpenCV_LIBS})
    set_property(
      TARGET "${name}::${name}" APPEND PROPERTY
      INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIRS})
  endif()
endmacro()
