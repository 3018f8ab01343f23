#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace rcpputils {

class AssertionException : public std::exception {
 public:
  explicit AssertionException(const char* text) : text_(text) {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

class IllegalStateException : public std::exception {
 public:
  explicit IllegalStateException(const char* text) : text_(text) {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// Throw `std::invalid_argument` unless an argument is as it has to be.
inline void require_true(bool condition,
                         const std::string& text = "invalid argument passed to function") {
  if (!condition) throw std::invalid_argument(text);
}

/// Throw `IllegalStateException` unless the program is in the state that it has to be in.
inline void check_true(bool condition, const std::string& text = "check reported invalid state") {
  if (!condition) throw IllegalStateException(text.c_str());
}

/// Throw `AssertionException` where a condition does not hold, in debug builds only.
inline void assert_true(bool condition, const std::string& text = "assertion failed") {
#ifndef NDEBUG
  if (!condition) throw AssertionException(text.c_str());
#else
  (void)condition;
  (void)text;
#endif
}

}  // namespace rcpputils
