#pragma once

#include <string>

#include "gazelle/core.hpp"

namespace ament_index_cpp {

// False where nobody has registered it.
inline bool get_resource(const std::string& resource_type, const std::string& resource_name,
                         std::string& content, std::string* prefix_path = nullptr) {
  const gazelle::Json found = gazelle::call(
      "ament/resource", gazelle::Json::object({{"type", resource_type}, {"name", resource_name}}));
  if (found.is_null()) return false;
  content = found[0].as_string();
  if (prefix_path != nullptr) *prefix_path = found[1].as_string();
  return true;
}

inline bool has_resource(const std::string& resource_type, const std::string& resource_name,
                         std::string* prefix_path = nullptr) {
  std::string content;
  return get_resource(resource_type, resource_name, content, prefix_path);
}

}  // namespace ament_index_cpp
