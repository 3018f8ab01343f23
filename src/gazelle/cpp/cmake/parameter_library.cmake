# generate_parameter_library(): a header with the parameters that a YAML file describes.

function(generate_parameter_library target yaml)
  get_filename_component(yaml "${yaml}" ABSOLUTE)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}/include")
  execute_process(
    COMMAND ${GAZELLE_PYTHON_COMMAND} parameters "${GAZELLE_SETTINGS}" "${folder}" "${yaml}"
      "${target}"
    RESULT_VARIABLE code)
  if(code)
    message(FATAL_ERROR "no header can be made of ${yaml}")
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${yaml}")
  file(WRITE "${folder}/${PROJECT_NAME}/${target}.hpp"
    "#pragma once\n#include <${target}.hpp>\n")
  set(folders "$<BUILD_INTERFACE:${folder}>" "$<INSTALL_INTERFACE:include/${PROJECT_NAME}>")
  if(ARGN)
    get_filename_component(validators "${ARGN}" ABSOLUTE)
    get_filename_component(place "${validators}" DIRECTORY)
    file(COPY "${validators}" DESTINATION "${folder}")
    get_filename_component(place "${place}" DIRECTORY)
    list(APPEND folders "$<BUILD_INTERFACE:${place}>")
  endif()
  gazelle_library_files(files rclcpp)
  add_library("${target}" INTERFACE)
  set_property(TARGET "${target}" PROPERTY INTERFACE_INCLUDE_DIRECTORIES "${folders}")
  set_property(TARGET "${target}" PROPERTY INTERFACE_LINK_LIBRARIES rclcpp::rclcpp)
  find_package(rclcpp QUIET)
  install(DIRECTORY "${folder}/" DESTINATION "include/${PROJECT_NAME}")
endfunction()

function(generate_parameter_module)
endfunction()
