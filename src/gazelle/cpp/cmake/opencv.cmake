# The system's OpenCV, which cv_bridge's and image_geometry's headers are written over.

macro(gazelle_with_opencv name)
  find_package(OpenCV QUIET COMPONENTS core imgproc imgcodecs calib3d)
  set(gazelle_opencv_headers ${OpenCV_INCLUDE_DIRS})
  set(gazelle_opencv_files ${OpenCV_LIBS})
  if(NOT OpenCV_FOUND)
    # Debian's development packages of single parts come without OpenCV's own configuration.
    find_path(GAZELLE_OPENCV_HEADERS opencv2/core.hpp PATH_SUFFIXES opencv4)
    if(GAZELLE_OPENCV_HEADERS)
      set(gazelle_opencv_headers "${GAZELLE_OPENCV_HEADERS}")
    endif()
    foreach(gazelle_part core imgproc imgcodecs calib3d)
      find_library(GAZELLE_OPENCV_${gazelle_part} opencv_${gazelle_part})
      if(GAZELLE_OPENCV_${gazelle_part})
        list(APPEND gazelle_opencv_files "${GAZELLE_OPENCV_${gazelle_part}}")
      endif()
    endforeach()
  endif()
  if(gazelle_opencv_headers)
    list(APPEND ${name}_LIBRARIES ${gazelle_opencv_files})
    list(APPEND ${name}_INCLUDE_DIRS ${gazelle_opencv_headers})
    set_property(
      TARGET "${name}::${name}" APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${gazelle_opencv_files})
    set_property(
      TARGET "${name}::${name}" APPEND PROPERTY
      INTERFACE_INCLUDE_DIRECTORIES ${gazelle_opencv_headers})
  endif()
endmacro()
