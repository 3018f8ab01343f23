#pragma once

#include <stdexcept>
#include <string>

#include "gazelle/core.hpp"

namespace ament_index_cpp {

class PackageNotFoundError : public std::out_of_range {
 public:
  explicit PackageNotFoundError(const std::string& package_name)
      : std::out_of_range("package '" + package_name + "' not found"), package_name(package_name) {}

  const std::string package_name;
};

namespace detail {
inline std::string of_package(const char* verb, const std::string& package_name) {
  if (package_name.empty())
    throw std::runtime_error("get_package_prefix() package name must not be empty");
  const gazelle::Json found =
      gazelle::call(verb, gazelle::Json::object({{"package", package_name}}));
  if (found.is_null()) throw PackageNotFoundError(package_name);
  return found.as_string();
}
}  // namespace detail

inline std::string get_package_prefix(const std::string& package_name) {
  return detail::of_package("ament/prefix", package_name);
}

}  // namespace ament_index_cpp
