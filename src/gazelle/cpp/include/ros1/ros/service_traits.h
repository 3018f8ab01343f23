#pragma once

#include <type_traits>

#include <gazelle/message.hpp>

namespace ros {
namespace service_traits {

namespace detail {
// The service that a class is, or is the request or response of.
template <class T, class = void>
struct Whole {
  using type = T;
};
template <class T>
struct Whole<T, std::void_t<typename ::gazelle::ServiceOf<T>::type>> {
  using type = typename ::gazelle::ServiceOf<T>::type;
};
}  // namespace detail

template <typename M>
struct MD5Sum {
  static const char* value() { return ask<M>(0); }
  static const char* value(const M&) { return value(); }

 private:
  template <class T>
  static const char* ask(decltype(::gazelle::Description<typename detail::Whole<T>::type>::md5,
                                  0)) {
    return ::gazelle::Description<typename detail::Whole<T>::type>::md5;
  }
  template <class T>
  static const char* ask(...) {
    return T::__s_getServerMD5Sum().c_str();
  }
};

template <typename M>
struct DataType {
  static const char* value() { return ask<M>(0); }
  static const char* value(const M&) { return value(); }

 private:
  template <class T>
  static const char* ask(
      decltype(::gazelle::Description<typename detail::Whole<T>::type>::ros1_type, 0)) {
    return ::gazelle::Description<typename detail::Whole<T>::type>::ros1_type;
  }
  template <class T>
  static const char* ask(...) {
    return T::__s_getServiceDataType().c_str();
  }
};

template <typename M>
inline const char* md5sum() {
  return MD5Sum<typename std::remove_cv<typename std::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* datatype() {
  return DataType<typename std::remove_cv<typename std::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* md5sum(const M& message) {
  return MD5Sum<typename std::remove_cv<M>::type>::value(message);
}
template <typename M>
inline const char* datatype(const M& message) {
  return DataType<typename std::remove_cv<M>::type>::value(message);
}

}  // namespace service_traits
}  // namespace ros
