// A value or why there is none: the part of tl::expected that parameter validators use.
#pragma once

#include <exception>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace tl {

template <class E>
class unexpected {
 public:
  explicit unexpected(const E& error) : error_(error) {}
  explicit unexpected(E&& error) : error_(std::move(error)) {}
  const E& value() const& { return error_; }
  E& value() & { return error_; }
  E&& value() && { return std::move(error_); }
  const E& error() const& { return error_; }

 private:
  E error_;
};

template <class E>
unexpected(E) -> unexpected<E>;

template <class E>
unexpected<std::decay_t<E>> make_unexpected(E&& error) {
  return unexpected<std::decay_t<E>>(std::forward<E>(error));
}

struct unexpect_t {
  explicit unexpect_t() = default;
};
inline constexpr unexpect_t unexpect{};

template <class E>
class bad_expected_access : public std::exception {
 public:
  explicit bad_expected_access(E error) : error_(std::move(error)) {}
  const char* what() const noexcept override { return "Bad expected access"; }
  const E& error() const { return error_; }

 private:
  E error_;
};

template <class T, class E>
class expected {
 public:
  using value_type = T;
  using error_type = E;
  using unexpected_type = unexpected<E>;

  template <class U = T, class = std::enable_if_t<std::is_default_constructible<U>::value>>
  expected() : content_(std::in_place_index<0>) {}
  template <class U = T, class = std::enable_if_t<std::is_constructible<T, U&&>::value &&
                                                  !std::is_same<std::decay_t<U>, expected>::value>>
  expected(U&& value) : content_(std::in_place_index<0>, std::forward<U>(value)) {}
  template <class G>
  expected(const unexpected<G>& error) : content_(std::in_place_index<1>, error.value()) {}
  template <class G>
  expected(unexpected<G>&& error) : content_(std::in_place_index<1>, std::move(error).value()) {}

  bool has_value() const noexcept { return content_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }

  T& value() & {
    check();
    return std::get<0>(content_);
  }
  const T& value() const& {
    check();
    return std::get<0>(content_);
  }
  T&& value() && {
    check();
    return std::move(std::get<0>(content_));
  }
  E& error() & { return std::get<1>(content_); }
  const E& error() const& { return std::get<1>(content_); }
  T& operator*() & { return std::get<0>(content_); }
  const T& operator*() const& { return std::get<0>(content_); }
  T&& operator*() && { return std::move(std::get<0>(content_)); }
  T* operator->() { return &std::get<0>(content_); }
  const T* operator->() const { return &std::get<0>(content_); }
  template <class U>
  T value_or(U&& other) const& {
    return has_value() ? **this : static_cast<T>(std::forward<U>(other));
  }

  template <class F>
  auto and_then(F&& f) const& -> std::invoke_result_t<F, const T&> {
    if (has_value()) return std::forward<F>(f)(**this);
    return unexpected<E>(error());
  }
  template <class F>
  auto map(F&& f) const& -> expected<std::invoke_result_t<F, const T&>, E> {
    if (has_value()) return std::forward<F>(f)(**this);
    return unexpected<E>(error());
  }
  template <class F>
  expected or_else(F&& f) const& {
    if (has_value()) return *this;
    if constexpr (std::is_void<std::invoke_result_t<F, const E&>>::value) {
      std::forward<F>(f)(error());
      return *this;
    } else {
      return std::forward<F>(f)(error());
    }
  }

 private:
  void check() const {
    if (!has_value()) throw bad_expected_access<E>(error());
  }
  std::variant<T, E> content_;
};

template <class E>
class expected<void, E> {
 public:
  using value_type = void;
  using error_type = E;
  using unexpected_type = unexpected<E>;

  expected() = default;
  template <class G>
  expected(const unexpected<G>& error) : error_(error.value()) {}
  template <class G>
  expected(unexpected<G>&& error) : error_(std::move(error).value()) {}

  bool has_value() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return has_value(); }
  void value() const {
    if (!has_value()) throw bad_expected_access<E>(*error_);
  }
  void operator*() const {}
  E& error() & { return *error_; }
  const E& error() const& { return *error_; }

  template <class F>
  auto and_then(F&& f) const& -> std::invoke_result_t<F> {
    if (has_value()) return std::forward<F>(f)();
    return unexpected<E>(error());
  }

 private:
  std::optional<E> error_;
};

}  // namespace tl
