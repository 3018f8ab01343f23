#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include <tcb_span/span.hpp>

namespace rsl {

// At most `capacity` values that need no memory of their own.
template <class T, std::size_t capacity>
class StaticVector {
 public:
  StaticVector() = default;
  StaticVector(const std::vector<T>& values) : size_(checked(values.size())) {
    std::copy(values.begin(), values.end(), values_.begin());
  }
  StaticVector(std::initializer_list<T> values) : size_(checked(values.size())) {
    std::copy(values.begin(), values.end(), values_.begin());
  }

  auto begin() const { return values_.cbegin(); }
  auto end() const { return values_.cbegin() + static_cast<std::ptrdiff_t>(size_); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.begin() + static_cast<std::ptrdiff_t>(size_); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  operator tcb::span<T>() { return {values_.data(), size_}; }
  operator tcb::span<const T>() const { return {values_.data(), size_}; }

 private:
  static std::size_t checked(std::size_t size) {
    if (size > capacity) {
      throw std::invalid_argument(std::to_string(size) + " values, the fixed array takes " +
                                  std::to_string(capacity));
    }
    return size;
  }

  std::array<T, capacity> values_{};
  std::size_t size_ = 0;
};

template <class T, std::size_t capacity>
std::vector<T> to_vector(const StaticVector<T, capacity>& values) {
  return std::vector<T>(values.begin(), values.end());
}

}  // namespace rsl
