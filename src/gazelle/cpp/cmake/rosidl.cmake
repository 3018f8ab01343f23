# Messages, services and actions of packages of ROS 2: their headers are generated while CMake reads
# the package.

gazelle_load(ament)

function(rosidl_generate_interfaces target)
  cmake_parse_arguments(arguments "ADD_LINTER_TESTS;SKIP_INSTALL;SKIP_GROUP_MEMBERSHIP_CHECK"
    "LIBRARY_NAME" "DEPENDENCIES" ${ARGN})
  set(paths)
  foreach(file IN LISTS arguments_UNPARSED_ARGUMENTS)
    # `folder:path` names a file of another folder.
    if(file MATCHES "^(/[^:]*):(.+)$")
      set(file "${CMAKE_MATCH_1}/${CMAKE_MATCH_2}")
    endif()
    get_filename_component(path "${file}" ABSOLUTE)
    if(NOT EXISTS "${path}")
      message(FATAL_ERROR
        "rosidl_generate_interfaces() the passed file '${file}' doesn't exist relative to the "
        "CMAKE_CURRENT_SOURCE_DIR '${CMAKE_CURRENT_SOURCE_DIR}'")
    endif()
    list(APPEND paths "${path}")
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${paths})
  set(folder "${CMAKE_BINARY_DIR}/rosidl_generator_cpp")
  execute_process(
    COMMAND ${GAZELLE_PYTHON_COMMAND} messages "${GAZELLE_SETTINGS}" "${folder}" ${paths}
    RESULT_VARIABLE code)
  if(code)
    message(FATAL_ERROR "the messages of ${PROJECT_NAME} have mistakes")
  endif()
  if(NOT TARGET "${target}")
    add_custom_target("${target}" ALL)
  endif()
  foreach(dependency IN LISTS arguments_DEPENDENCIES)
    list(APPEND links ${${dependency}_TARGETS})
  endforeach()
  foreach(kind cpp c introspection_cpp introspection_c)
    foreach(part generator typesupport)
      set(name "${target}__rosidl_${part}_${kind}")
      if(NOT TARGET "${name}")
        add_library("${name}" INTERFACE)
        add_library("${PROJECT_NAME}::${name}" ALIAS "${name}")
        set_property(TARGET "${name}" PROPERTY INTERFACE_INCLUDE_DIRECTORIES
          "$<BUILD_INTERFACE:${folder}>" "$<INSTALL_INTERFACE:include/${PROJECT_NAME}>")
        set_property(TARGET "${name}" PROPERTY INTERFACE_LINK_LIBRARIES "${links}")
        list(APPEND made "${name}")
      endif()
    endforeach()
  endforeach()
  # Where one package has both, its own nodes may include what is generated without more ado.
  set_property(GLOBAL APPEND PROPERTY gazelle_interface_folders "${folder}")
  if(NOT arguments_SKIP_INSTALL)
    install(DIRECTORY "${folder}/${PROJECT_NAME}" DESTINATION "include/${PROJECT_NAME}")
    foreach(path IN LISTS paths)
      get_filename_component(parent "${path}" DIRECTORY)
      get_filename_component(kind "${parent}" NAME)
      install(FILES "${path}" DESTINATION "share/${PROJECT_NAME}/${kind}")
    endforeach()
    install(TARGETS ${made} EXPORT "gazelle_interfaces_${target}")
    ament_export_targets("gazelle_interfaces_${target}")
    ament_export_include_directories("include/${PROJECT_NAME}")
    ament_export_dependencies(${arguments_DEPENDENCIES})
    ament_index_register_resource(rosidl_interfaces)
  endif()
  set(${target}_FOUND TRUE PARENT_SCOPE)
  set(rosidl_generate_interfaces_TARGETS
    ${rosidl_generate_interfaces_TARGETS} "${target}" PARENT_SCOPE)
endfunction()

function(rosidl_get_typesupport_target variable target typesupport)
  set(${variable} "${target}__${typesupport}" PARENT_SCOPE)
endfunction()

function(rosidl_target_interfaces target interfaces typesupport)
  foreach(property "" INTERFACE_)
    set_property(TARGET "${target}" APPEND PROPERTY
      ${property}INCLUDE_DIRECTORIES "$<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/rosidl_generator_cpp>")
  endforeach()
  add_dependencies("${target}" "${interfaces}")
endfunction()
