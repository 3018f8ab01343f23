#pragma once

#include <filesystem>
#include <string>

#include "ament_index_cpp/get_package_prefix.hpp"

namespace ament_index_cpp {

inline std::string get_package_share_directory(const std::string& package_name) {
  return detail::of_package("ament/share", package_name);
}
inline std::filesystem::path get_package_share_path(const std::string& package_name) {
  return get_package_share_directory(package_name);
}
inline void get_package_share_directory(const std::string& package_name,
                                        std::filesystem::path& path) {
  path = get_package_share_directory(package_name);
}

}  // namespace ament_index_cpp
