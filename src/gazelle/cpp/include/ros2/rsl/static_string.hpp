#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rsl {

// A text of at most `capacity` letters that needs no memory of its own.
template <std::size_t capacity>
class StaticString {
 public:
  StaticString() = default;
  StaticString(const std::string& text) : StaticString(std::string_view(text)) {}
  StaticString(const char* text) : StaticString(std::string_view(text)) {}
  StaticString(std::string_view text) : size_(text.size()) {
    if (size_ > capacity) {
      throw std::invalid_argument("the text has " + std::to_string(size_) +
                                  " letters, the fixed string takes " + std::to_string(capacity));
    }
    std::copy(text.begin(), text.end(), letters_.begin());
  }

  auto begin() const { return letters_.cbegin(); }
  auto end() const { return letters_.cbegin() + static_cast<std::ptrdiff_t>(size_); }
  auto begin() { return letters_.begin(); }
  auto end() { return letters_.begin() + static_cast<std::ptrdiff_t>(size_); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  operator std::string_view() const { return {letters_.data(), size_}; }

 private:
  std::array<char, capacity> letters_{};
  std::size_t size_ = 0;
};

template <std::size_t capacity>
std::string to_string(const StaticString<capacity>& text) {
  return std::string(std::string_view(text));
}

}  // namespace rsl
