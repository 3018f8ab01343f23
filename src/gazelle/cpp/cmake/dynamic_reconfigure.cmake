# Headers of .cfg files.

macro(generate_dynamic_reconfigure_options)
  foreach(gazelle_file ${ARGN})
    get_filename_component(gazelle_file "${gazelle_file}" ABSOLUTE)
    execute_process(
      COMMAND ${GAZELLE_PYTHON_COMMAND} config "${GAZELLE_SETTINGS}" "${GAZELLE_DEVEL}/include"
        "${gazelle_file}"
      RESULT_VARIABLE gazelle_code)
    if(gazelle_code)
      message(FATAL_ERROR "no header can be made of ${gazelle_file}")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${gazelle_file}")
  endforeach()
  include_directories("${GAZELLE_DEVEL}/include")
  if(NOT TARGET ${PROJECT_NAME}_gencfg)
    add_custom_target(${PROJECT_NAME}_gencfg)
  endif()
  list(APPEND ${PROJECT_NAME}_EXPORTED_TARGETS ${PROJECT_NAME}_gencfg)
  install(DIRECTORY "${GAZELLE_DEVEL}/include/${PROJECT_NAME}" DESTINATION include OPTIONAL)
endmacro()
