#pragma once

#include <utility>

namespace rcpputils {

/// Calls something when its scope ends.
template <typename Callable>
class scope_exit final {
 public:
  explicit scope_exit(Callable callable) : callable_(std::move(callable)) {}
  scope_exit(const scope_exit&) = delete;
  scope_exit(scope_exit&& other) : callable_(std::move(other.callable_)), live_(other.live_) {
    other.live_ = false;
  }
  scope_exit& operator=(const scope_exit&) = delete;
  scope_exit& operator=(scope_exit&&) = delete;
  ~scope_exit() {
    if (live_) callable_();
  }
  void cancel() { live_ = false; }

 private:
  Callable callable_;
  bool live_ = true;
};

template <typename Callable>
scope_exit<Callable> make_scope_exit(Callable&& callable) {
  return scope_exit<Callable>(std::forward<Callable>(callable));
}

}  // namespace rcpputils

#define GAZELLE_RCPPUTILS_JOIN_IMPL(a, b) a##b
#define GAZELLE_RCPPUTILS_JOIN(a, b) GAZELLE_RCPPUTILS_JOIN_IMPL(a, b)
#define RCPPUTILS_SCOPE_EXIT(code) \
  auto GAZELLE_RCPPUTILS_JOIN(scope_exit_, __LINE__) = rcpputils::make_scope_exit([&]() { code; })
