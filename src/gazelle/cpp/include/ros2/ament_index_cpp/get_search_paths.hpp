#pragma once

#include <list>
#include <string>

#include "gazelle/core.hpp"

namespace ament_index_cpp {

inline std::list<std::string> get_search_paths() {
  const auto paths = gazelle::call("ament/search_paths").as_strings();
  return {paths.begin(), paths.end()};
}

}  // namespace ament_index_cpp
