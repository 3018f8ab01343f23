// What roscpp asks of a message's class. Generated classes answer by gazelle::Description; users
// specialise these templates for classes of their own.
#pragma once

#include <string>
#include <type_traits>

#include <boost/utility/enable_if.hpp>

#include <ros/message_forward.h>
#include <ros/time.h>

#include <gazelle/message.hpp>

namespace std_msgs {
ROS_DECLARE_MESSAGE(Header)
}

// Lets the classes of an allocator-less message answer by static members, as rosbuild's did.
#define ROS_IMPLEMENT_SIMPLE_TOPIC_TRAITS(msg, md5sum, datatype, definition) \
  namespace ros {                                                            \
  namespace message_traits {                                                 \
  template <>                                                                \
  struct MD5Sum<msg> {                                                       \
    static const char* value() { return md5sum; }                            \
    static const char* value(const msg&) { return value(); }                 \
  };                                                                         \
  template <>                                                                \
  struct DataType<msg> {                                                     \
    static const char* value() { return datatype; }                          \
    static const char* value(const msg&) { return value(); }                 \
  };                                                                         \
  template <>                                                                \
  struct Definition<msg> {                                                   \
    static const char* value() { return definition; }                        \
    static const char* value(const msg&) { return value(); }                 \
  };                                                                         \
  }                                                                          \
  }

namespace ros {
namespace message_traits {

struct TrueType {
  static const bool value = true;
  typedef TrueType type;
};
struct FalseType {
  static const bool value = false;
  typedef FalseType type;
};

namespace detail {

template <bool Value>
struct Answer : std::conditional<Value, TrueType, FalseType>::type {};

template <class M, class = void>
struct Known {
  static constexpr bool is_message = false;
  static constexpr bool is_fixed_size = false;
  static constexpr bool has_header = false;
};
template <class M>
struct Known<M, typename std::enable_if<::gazelle::is_message_v<M>>::type> {
  static constexpr bool is_message = true;
  static constexpr bool is_fixed_size = ::gazelle::Description<M>::is_fixed_size;
  static constexpr bool has_header = ::gazelle::Description<M>::has_header;
};

}  // namespace detail

template <typename M, typename Enable = void>
struct IsMessage : detail::Answer<detail::Known<M>::is_message> {};
template <typename M, typename Enable = void>
struct IsFixedSize : detail::Answer<detail::Known<M>::is_fixed_size> {};
template <typename M, typename Enable = void>
struct HasHeader : detail::Answer<detail::Known<M>::has_header> {};
// Whether the bytes on the wire are those in memory: never so for us, who write by tables.
template <typename M, typename Enable = void>
struct IsSimple : FalseType {};

template <typename M>
struct IsMessage<const M, typename boost::disable_if<std::is_const<M>>::type> : IsMessage<M> {};
template <typename M>
struct IsFixedSize<const M, typename boost::disable_if<std::is_const<M>>::type> : IsFixedSize<M> {};
template <typename M>
struct HasHeader<const M, typename boost::disable_if<std::is_const<M>>::type> : HasHeader<M> {};

template <typename M, typename Enable = void>
struct MD5Sum {
  static const char* value() { return ask<M>(0); }
  static const char* value(const M& message) { return ask_of(message, 0); }

 private:
  using Bare = typename std::remove_cv<M>::type;
  template <class T>
  static const char* ask(decltype(::gazelle::Description<typename std::remove_cv<T>::type>::md5,
                                  0)) {
    return ::gazelle::Description<Bare>::md5;
  }
  template <class T>
  static const char* ask(...) {
    return T::__s_getMD5Sum().c_str();
  }
  template <class T>
  static auto ask_of(const T& message, int) -> decltype(message.__getMD5Sum().c_str()) {
    return message.__getMD5Sum().c_str();
  }
  template <class T>
  static const char* ask_of(const T&, long) {
    return value();
  }
};

template <typename M, typename Enable = void>
struct DataType {
  static const char* value() { return ask<M>(0); }
  static const char* value(const M& message) { return ask_of(message, 0); }

 private:
  using Bare = typename std::remove_cv<M>::type;
  template <class T>
  static const char* ask(
      decltype(::gazelle::Description<typename std::remove_cv<T>::type>::ros1_type, 0)) {
    return ::gazelle::Description<Bare>::ros1_type;
  }
  template <class T>
  static const char* ask(...) {
    return T::__s_getDataType().c_str();
  }
  template <class T>
  static auto ask_of(const T& message, int) -> decltype(message.__getDataType().c_str()) {
    return message.__getDataType().c_str();
  }
  template <class T>
  static const char* ask_of(const T&, long) {
    return value();
  }
};

template <typename M, typename Enable = void>
struct Definition {
  static const char* value() { return ask<M>(0); }
  static const char* value(const M& message) { return ask_of(message, 0); }

 private:
  using Bare = typename std::remove_cv<M>::type;
  template <class T>
  static const char* ask(
      decltype(::gazelle::Description<typename std::remove_cv<T>::type>::definition, 0)) {
    return ::gazelle::Description<Bare>::definition();
  }
  template <class T>
  static const char* ask(...) {
    return T::__s_getMessageDefinition().c_str();
  }
  template <class T>
  static auto ask_of(const T& message, int) -> decltype(message.__getMessageDefinition().c_str()) {
    return message.__getMessageDefinition().c_str();
  }
  template <class T>
  static const char* ask_of(const T&, long) {
    return value();
  }
};

template <typename M, typename Enable = void>
struct Header {
  static std_msgs::Header* pointer(M&) { return nullptr; }
  static std_msgs::Header const* pointer(const M&) { return nullptr; }
};
template <typename M>
struct Header<M, typename boost::enable_if<HasHeader<M>>::type> {
  static std_msgs::Header* pointer(typename std::remove_const<M>::type& m) { return &m.header; }
  static std_msgs::Header const* pointer(const M& m) { return &m.header; }
};

template <typename M, typename Enable = void>
struct FrameId {
  static std::string* pointer(M&) { return nullptr; }
  static std::string const* pointer(const M&) { return nullptr; }
};
template <typename M>
struct FrameId<M, typename boost::enable_if<HasHeader<M>>::type> {
  static std::string* pointer(typename std::remove_const<M>::type& m) { return &m.header.frame_id; }
  static std::string const* pointer(const M& m) { return &m.header.frame_id; }
  static std::string value(const M& m) { return m.header.frame_id; }
};

template <typename M, typename Enable = void>
struct TimeStamp {
  static ros::Time* pointer(M&) { return nullptr; }
  static ros::Time const* pointer(const M&) { return nullptr; }
};
template <typename M>
struct TimeStamp<M, typename boost::enable_if<HasHeader<M>>::type> {
  static ros::Time* pointer(typename std::remove_const<M>::type& m) { return &m.header.stamp; }
  static ros::Time const* pointer(const M& m) { return &m.header.stamp; }
  static ros::Time value(const M& m) { return m.header.stamp; }
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
inline const char* definition() {
  return Definition<
      typename std::remove_cv<typename std::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* md5sum(const M& message) {
  return MD5Sum<typename std::remove_cv<M>::type>::value(message);
}
template <typename M>
inline const char* datatype(const M& message) {
  return DataType<typename std::remove_cv<M>::type>::value(message);
}
template <typename M>
inline const char* definition(const M& message) {
  return Definition<typename std::remove_cv<M>::type>::value(message);
}

template <typename M>
inline std_msgs::Header* header(M& message) {
  return Header<typename std::remove_cv<M>::type>::pointer(message);
}
template <typename M>
inline std_msgs::Header const* header(const M& message) {
  return Header<typename std::remove_cv<M>::type>::pointer(message);
}
template <typename M>
inline std::string* frameId(M& message) {
  return FrameId<typename std::remove_cv<M>::type>::pointer(message);
}
template <typename M>
inline std::string const* frameId(const M& message) {
  return FrameId<typename std::remove_cv<M>::type>::pointer(message);
}
template <typename M>
inline ros::Time* timeStamp(M& message) {
  return TimeStamp<typename std::remove_cv<M>::type>::pointer(message);
}
template <typename M>
inline ros::Time const* timeStamp(const M& message) {
  return TimeStamp<typename std::remove_cv<M>::type>::pointer(message);
}

template <typename M>
inline bool isSimple() {
  return IsSimple<typename std::remove_cv<typename std::remove_reference<M>::type>::type>::value;
}
template <typename M>
inline bool isFixedSize() {
  return IsFixedSize<typename std::remove_cv<typename std::remove_reference<M>::type>::type>::value;
}
template <typename M>
inline bool hasHeader() {
  return HasHeader<typename std::remove_cv<typename std::remove_reference<M>::type>::type>::value;
}

}  // namespace message_traits
}  // namespace ros
