# Plug-in descriptions, as pluginlib's own function installs and registers them.

gazelle_load(class_loader)

macro(pluginlib_export_plugin_description_file category file)
  get_filename_component(gazelle_name "${file}" NAME)
  get_filename_component(gazelle_folder "${file}" DIRECTORY)
  set(gazelle_target "share/${PROJECT_NAME}")
  if(gazelle_folder)
    set(gazelle_target "${gazelle_target}/${gazelle_folder}")
  endif()
  install(FILES "${file}" DESTINATION "${gazelle_target}")
  set_property(GLOBAL APPEND_STRING PROPERTY "gazelle_plugins_${category}" "share/${PROJECT_NAME}/${file}\n")
  get_property(gazelle_text GLOBAL PROPERTY "gazelle_plugins_${category}")
  ament_index_register_resource("${category}__pluginlib__plugin" CONTENT "${gazelle_text}")
endmacro()

macro(pluginlib_enable_plugin_testing)
endmacro()
