# Components of rclcpp: their registration in ament's index, and programs of one component each.

function(gazelle_register_components target index)
  foreach(class IN LISTS ARGN)
    set_property(GLOBAL APPEND_STRING PROPERTY gazelle_components_${index}
      "${class};lib/$<TARGET_FILE_NAME:${target}>\n")
  endforeach()
  set_property(GLOBAL PROPERTY gazelle_components_project "${PROJECT_NAME}")
  get_property(known GLOBAL PROPERTY gazelle_component_indices)
  if(NOT "${index}" IN_LIST known)
    set_property(GLOBAL APPEND PROPERTY gazelle_component_indices "${index}")
    set(folder "share/ament_index/resource_index/${index}")
    install(FILES "${CMAKE_BINARY_DIR}/ament_index/${folder}/${PROJECT_NAME}"
      DESTINATION "${folder}")
    if(NOT known)
      cmake_language(DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL gazelle_write_components)
    endif()
  endif()
endfunction()

function(gazelle_write_components)
  get_property(name GLOBAL PROPERTY gazelle_components_project)
  get_property(indices GLOBAL PROPERTY gazelle_component_indices)
  foreach(index IN LISTS indices)
    get_property(text GLOBAL PROPERTY gazelle_components_${index})
    file(GENERATE OUTPUT
      "${CMAKE_BINARY_DIR}/ament_index/share/ament_index/resource_index/${index}/${name}"
      CONTENT "${text}")
  endforeach()
endfunction()

function(rclcpp_components_register_nodes target)
  cmake_parse_arguments(arguments "" "RESOURCE_INDEX" "" ${ARGN})
  if(NOT arguments_RESOURCE_INDEX)
    set(arguments_RESOURCE_INDEX rclcpp_components)
  endif()
  gazelle_register_components("${target}" "${arguments_RESOURCE_INDEX}"
    ${arguments_UNPARSED_ARGUMENTS})
endfunction()

function(rclcpp_components_register_node target)
  cmake_parse_arguments(arguments "NO_UNDEFINED_SYMBOLS" "PLUGIN;EXECUTABLE;EXECUTOR;RESOURCE_INDEX"
    "" ${ARGN})
  if(NOT arguments_RESOURCE_INDEX)
    set(arguments_RESOURCE_INDEX rclcpp_components)
  endif()
  if(NOT arguments_EXECUTOR)
    set(arguments_EXECUTOR SingleThreadedExecutor)
  endif()
  gazelle_register_components("${target}" "${arguments_RESOURCE_INDEX}" "${arguments_PLUGIN}")
  if(arguments_EXECUTABLE)
    set(component "${arguments_PLUGIN}")
    set(executor "${arguments_EXECUTOR}")
    set(source "${CMAKE_BINARY_DIR}/rclcpp_components/node_main_${arguments_EXECUTABLE}.cpp")
    configure_file("${GAZELLE_CMAKE_FOLDER}/component_main.cpp.in" "${source}" @ONLY)
    add_executable("${arguments_EXECUTABLE}" "${source}")
    gazelle_library_files(files rclcpp_components)
    # The library registers its classes when it is loaded: nothing in it is named here.
    set_property(TARGET "${arguments_EXECUTABLE}" APPEND PROPERTY LINK_LIBRARIES
      "-Wl,--no-as-needed" "${target}" "-Wl,--as-needed" ${files})
    install(TARGETS "${arguments_EXECUTABLE}" DESTINATION "lib/${PROJECT_NAME}")
  endif()
endfunction()
