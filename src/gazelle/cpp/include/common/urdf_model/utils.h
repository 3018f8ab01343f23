#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace urdf {

// The words between characters of `separators`; two of them in a row have an empty word between.
inline void split_string(std::vector<std::string>& result, const std::string& input,
                         const std::string& separators) {
  std::string::size_type begin = 0;
  while (begin < input.size()) {
    const auto end = input.find_first_of(separators, begin);
    result.push_back(input.substr(begin, end - begin));
    if (end == std::string::npos) return;
    begin = end + 1;
  }
}

// A number, whatever the locale of the program is.
inline double strToDouble(const char* text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  if (stream.fail() || !(stream >> std::ws).eof()) {
    throw std::runtime_error(std::string("Failed converting string to double: ") + text);
  }
  return value;
}

}  // namespace urdf
