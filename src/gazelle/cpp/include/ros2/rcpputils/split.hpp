#pragma once

#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace rcpputils {

/// Split a text at a character and put the parts through an iterator.
template <class InsertIterator>
void split(const std::string& text, char at, InsertIterator parts, bool skip_empty = false) {
  std::size_t begin = 0;
  if (text.empty()) {
    if (!skip_empty) *parts = std::string();
    return;
  }
  for (;;) {
    const std::size_t end = text.find(at, begin);
    std::string part = text.substr(begin, end == std::string::npos ? end : end - begin);
    if (!(skip_empty && part.empty())) *parts++ = std::move(part);
    if (end == std::string::npos) return;
    begin = end + 1;
  }
}

inline std::vector<std::string> split(const std::string& text, char at, bool skip_empty = false) {
  std::vector<std::string> parts;
  split(text, at, std::back_inserter(parts), skip_empty);
  return parts;
}

}  // namespace rcpputils
