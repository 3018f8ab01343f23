#pragma once

#include <ros/exceptions.h>
#include <ros/names.h>

#include <string>

namespace topic_tools {

/// The last part of a topic's name, as a name of its own.
inline bool getBaseName(const std::string& full_name, std::string& base_name) {
  std::string error;
  if (!ros::names::validate(full_name, error)) return false;
  const std::string clean = ros::names::clean(full_name);
  base_name = clean.substr(clean.rfind('/') + 1);
  return !base_name.empty();
}

}  // namespace topic_tools
