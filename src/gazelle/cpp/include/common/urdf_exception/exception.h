#pragma once

#include <stdexcept>
#include <string>

namespace urdf {

class ParseError : public std::runtime_error {
 public:
  explicit ParseError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace urdf
