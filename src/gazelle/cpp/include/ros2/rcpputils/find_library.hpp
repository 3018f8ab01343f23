#pragma once

#include <filesystem>
#include <string>

#include "rcpputils/env.hpp"
#include "rcpputils/split.hpp"

namespace rcpputils {

/// Return the file of a library on the loader's path, empty where there is none.
inline std::string find_library_path(const std::string& name) {
  for (const auto& folder : split(get_env_var("LD_LIBRARY_PATH"), ':', true)) {
    const std::string file = folder + "/lib" + name + ".so";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return "";
}

inline std::string path_for_library(const std::string& folder, const std::string& name) {
  const std::string file = folder + "/lib" + name + ".so";
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) ? file : "";
}

inline std::string filename_for_library(const std::string& name) { return "lib" + name + ".so"; }

}  // namespace rcpputils
