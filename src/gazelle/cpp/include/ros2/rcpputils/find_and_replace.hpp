#pragma once

#include <string>

namespace rcpputils {

/// Return a text with every occurrence of one word replaced by another.
inline std::string find_and_replace(const std::string& text, const std::string& wanted,
                                    const std::string& replacement) {
  std::string replaced = text;
  if (wanted.empty()) return replaced;
  for (std::size_t at = 0; (at = replaced.find(wanted, at)) != std::string::npos;
       at += replacement.size()) {
    replaced.replace(at, wanted.size(), replacement);
  }
  return replaced;
}

}  // namespace rcpputils
