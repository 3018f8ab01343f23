#pragma once

#include "class_loader/class_loader.hpp"

// Makes a class known to pluginlib; its name is the `type` of the plug-in description.
#define PLUGINLIB_EXPORT_CLASS(class_type, base_class_type) \
  CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)

// The forms of Electric and before, and of Fuerte.
#define PLUGINLIB_DECLARE_CLASS(pkg, class_name, class_type, base_class_type) \
  CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)
#define PLUGINLIB_REGISTER_CLASS(class_name, class_type, base_class_type) \
  CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)
