#pragma once

#include <sstream>
#include <string>

namespace rcpputils {

/// Join what a container holds into a text.
template <typename Container, typename Character>
std::basic_string<Character> join(const Container& items,
                                  const std::basic_string<Character>& between) {
  std::basic_ostringstream<Character> text;
  bool first = true;
  for (const auto& item : items) {
    if (!first) text << between;
    text << item;
    first = false;
  }
  return text.str();
}

template <typename Container, typename Character>
std::basic_string<Character> join(const Container& items, const Character* between) {
  return join(items, std::basic_string<Character>(between));
}

}  // namespace rcpputils
