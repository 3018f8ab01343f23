#pragma once

#include <map>
#include <string>

#include "gazelle/core.hpp"

namespace ament_index_cpp {

// Names of what is registered, with the prefixes.
inline std::map<std::string, std::string> get_resources(const std::string& resource_type) {
  std::map<std::string, std::string> found;
  const gazelle::Json answer =
      gazelle::call("ament/resources", gazelle::Json::object({{"type", resource_type}}));
  for (const auto& member : answer.members()) found[member.first] = member.second.as_string();
  return found;
}

}  // namespace ament_index_cpp
