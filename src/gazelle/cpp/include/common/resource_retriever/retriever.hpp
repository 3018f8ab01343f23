#pragma once

#include <boost/shared_array.hpp>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "gazelle/core.hpp"

namespace resource_retriever {

class Exception : public std::runtime_error {
 public:
  Exception(const std::string& file, const std::string& error_msg)
      : std::runtime_error("Error retrieving file [" + file + "]: " + error_msg) {}
};

// The bytes of a file.
struct MemoryResource {
  boost::shared_array<std::uint8_t> data;
  std::uint32_t size = 0;
};

// Reads what package:// and file:// mean.
class Retriever {
 public:
  MemoryResource get(const std::string& url) {
    const std::string path = path_of(url);
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Exception(url, "cannot open " + path);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)),
                                  std::istreambuf_iterator<char>());
    MemoryResource resource;
    resource.size = static_cast<std::uint32_t>(bytes.size());
    resource.data.reset(new std::uint8_t[bytes.size() + 1]);
    std::memcpy(resource.data.get(), bytes.data(), bytes.size());
    return resource;
  }

 private:
  static std::string path_of(const std::string& url) {
    const std::string package = "package://", file = "file://";
    if (url.compare(0, file.size(), file) == 0) return url.substr(file.size());
    if (url.compare(0, package.size(), package) != 0) {
      throw Exception(url, "only package:// and file:// can be read");
    }
    const auto slash = url.find('/', package.size());
    if (slash == std::string::npos) {
      throw Exception(url, "Could not parse package:// format into file:// format");
    }
    const std::string name = url.substr(package.size(), slash - package.size());
    const gazelle::Json found =
        gazelle::call("package/path", gazelle::Json::object({{"package", name}}));
    if (found.is_null()) throw Exception(url, "Package [" + name + "] does not exist");
    return found.as_string() + url.substr(slash);
  }
};

}  // namespace resource_retriever
