#pragma once

#include <memory>
#include <type_traits>

namespace rcpputils {
namespace details {

template <class T>
struct pointer : std::false_type {
  using element = T;
};
template <class T>
struct pointer<T*> : std::true_type {
  using element = T;
};
template <class T>
struct pointer<std::shared_ptr<T>> : std::true_type {
  using element = T;
};
template <class T, class D>
struct pointer<std::unique_ptr<T, D>> : std::true_type {
  using element = T;
};

}  // namespace details

template <class T>
struct is_pointer : details::pointer<std::remove_cv_t<std::remove_reference_t<T>>> {};

template <class T>
struct remove_pointer {
  using type = typename details::pointer<std::remove_cv_t<std::remove_reference_t<T>>>::element;
};

}  // namespace rcpputils
