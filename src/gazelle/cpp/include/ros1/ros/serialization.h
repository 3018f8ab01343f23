// ROS 1's bytes of messages, and of classes that users describe by ros::serialization::Serializer.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/array.hpp>
#include <boost/call_traits.hpp>
#include <boost/shared_array.hpp>
#include <boost/shared_ptr.hpp>

#include <ros/builtin_message_traits.h>
#include <ros/datatypes.h>
#include <ros/exception.h>
#include <ros/message_traits.h>
#include <ros/serialized_message.h>
#include <ros/time.h>
#include <ros/types.h>

#include <gazelle/message.hpp>

#define ROS_NEW_SERIALIZATION_API 1

// A Serializer's three functions, all by its `allInOne`.
#define ROS_DECLARE_ALLINONE_SERIALIZER                         \
  template <typename Stream, typename T>                        \
  inline static void write(Stream& stream, const T& t) {        \
    allInOne<Stream, const T&>(stream, t);                      \
  }                                                             \
  template <typename Stream, typename T>                        \
  inline static void read(Stream& stream, T& t) {               \
    allInOne<Stream, T&>(stream, t);                            \
  }                                                             \
  template <typename T>                                         \
  inline static uint32_t serializedLength(const T& t) {         \
    ros::serialization::LStream stream;                         \
    allInOne<ros::serialization::LStream, const T&>(stream, t); \
    return stream.getLength();                                  \
  }

namespace ros {
namespace serialization {

namespace mt = message_traits;

class StreamOverrunException : public ros::Exception {
 public:
  explicit StreamOverrunException(const std::string& what) : Exception(what) {}
};

[[noreturn]] inline void throwStreamOverrun() { throw StreamOverrunException("Buffer Overrun"); }

namespace stream_types {
enum StreamType { Input, Output, Length };
}
typedef stream_types::StreamType StreamType;

struct Stream {
  uint8_t* getData() { return data_; }
  uint8_t* advance(uint32_t len) {
    if (len > getLength()) throwStreamOverrun();
    uint8_t* const before = data_;
    data_ += len;
    return before;
  }
  uint32_t getLength() { return static_cast<uint32_t>(end_ - data_); }

 protected:
  Stream(uint8_t* data, uint32_t count) : data_(data), end_(data + count) {}

 private:
  uint8_t* data_;
  uint8_t* end_;
};

template <typename T>
struct Serializer;

template <typename T, typename Stream>
inline void serialize(Stream& stream, const T& t);
template <typename T, typename Stream>
inline void deserialize(Stream& stream, T& t);
template <typename T>
inline uint32_t serializationLength(const T& t);

struct IStream : public Stream {
  static const StreamType stream_type = stream_types::Input;
  IStream(uint8_t* data, uint32_t count) : Stream(data, count) {}
  template <typename T>
  void next(T& t) {
    deserialize(*this, t);
  }
  template <typename T>
  IStream& operator>>(T& t) {
    deserialize(*this, t);
    return *this;
  }
};

struct OStream : public Stream {
  static const StreamType stream_type = stream_types::Output;
  OStream(uint8_t* data, uint32_t count) : Stream(data, count) {}
  template <typename T>
  void next(const T& t) {
    serialize(*this, t);
  }
  template <typename T>
  OStream& operator<<(const T& t) {
    serialize(*this, t);
    return *this;
  }
};

struct LStream {
  static const StreamType stream_type = stream_types::Length;
  LStream() : count_(0) {}
  template <typename T>
  void next(const T& t) {
    count_ += serializationLength(t);
  }
  uint32_t advance(uint32_t len) {
    const uint32_t before = count_;
    count_ += len;
    return before;
  }
  uint32_t getLength() { return count_; }

 private:
  uint32_t count_;
};

namespace detail {

template <typename T>
inline constexpr bool is_number_v = std::is_arithmetic<T>::value || std::is_enum<T>::value;

// A bool is a byte on the wire.
template <typename T>
struct Wire {
  using type = T;
};
template <>
struct Wire<bool> {
  using type = uint8_t;
};

}  // namespace detail

// For generated messages and numbers; users specialise it for classes of their own.
template <typename T>
struct Serializer {
  template <typename Stream>
  inline static void write(Stream& stream, typename boost::call_traits<T>::param_type t) {
    if constexpr (detail::is_number_v<T>) {
      const typename detail::Wire<T>::type value = t;
      std::memcpy(stream.advance(sizeof(value)), &value, sizeof(value));
    } else if constexpr (::gazelle::is_message_v<T>) {
      const uint32_t left = stream.getLength();
      const auto& layout = ::gazelle::Description<T>::layout();
      const std::size_t size = ::gazelle::ros1_size(layout, &t);
      if (size > left) throwStreamOverrun();
      ::gazelle::encode_ros1(layout, &t, stream.advance(static_cast<uint32_t>(size)), size);
    } else {
      t.serialize(stream.getData(), 0);
    }
  }
  template <typename Stream>
  inline static void read(Stream& stream, T& t) {
    if constexpr (detail::is_number_v<T>) {
      typename detail::Wire<T>::type value;
      std::memcpy(&value, stream.advance(sizeof(value)), sizeof(value));
      t = static_cast<T>(value);
    } else if constexpr (::gazelle::is_message_v<T>) {
      try {
        stream.advance(static_cast<uint32_t>(::gazelle::decode_ros1(
            ::gazelle::Description<T>::layout(), &t, stream.getData(), stream.getLength())));
      } catch (const ::gazelle::Error&) {
        throwStreamOverrun();
      }
    } else {
      t.deserialize(stream.getData());
    }
  }
  inline static uint32_t serializedLength(typename boost::call_traits<T>::param_type t) {
    if constexpr (detail::is_number_v<T>) {
      return sizeof(typename detail::Wire<T>::type);
    } else if constexpr (::gazelle::is_message_v<T>) {
      return static_cast<uint32_t>(::gazelle::ros1_size(::gazelle::Description<T>::layout(), &t));
    } else {
      return t.serializationLength();
    }
  }
};

template <class Allocator>
struct Serializer<std::basic_string<char, std::char_traits<char>, Allocator>> {
  typedef std::basic_string<char, std::char_traits<char>, Allocator> StringType;
  template <typename Stream>
  inline static void write(Stream& stream, const StringType& text) {
    serialize(stream, static_cast<uint32_t>(text.size()));
    if (!text.empty()) {
      std::memcpy(stream.advance(static_cast<uint32_t>(text.size())), text.data(), text.size());
    }
  }
  template <typename Stream>
  inline static void read(Stream& stream, StringType& text) {
    uint32_t size = 0;
    deserialize(stream, size);
    const uint8_t* const start = stream.advance(size);
    text.assign(reinterpret_cast<const char*>(start), size);
  }
  inline static uint32_t serializedLength(const StringType& text) {
    return 4 + static_cast<uint32_t>(text.size());
  }
};

namespace detail {
template <class TimeClass>
struct TimeSerializer {
  template <typename Stream>
  inline static void write(Stream& stream, const TimeClass& time) {
    serialize(stream, time.sec);
    serialize(stream, time.nsec);
  }
  template <typename Stream>
  inline static void read(Stream& stream, TimeClass& time) {
    deserialize(stream, time.sec);
    deserialize(stream, time.nsec);
  }
  inline static uint32_t serializedLength(const TimeClass&) { return 8; }
};

template <typename Stream, typename T>
inline void write_each(Stream& stream, const T& values) {
  for (const auto& value : values) serialize(stream, value);
}
template <typename Stream, typename T>
inline void read_each(Stream& stream, T& values) {
  for (auto& value : values) deserialize(stream, value);
}
template <typename T>
inline uint32_t length_of_each(const T& values) {
  uint32_t size = 0;
  for (const auto& value : values) size += serializationLength(value);
  return size;
}
}  // namespace detail

template <>
struct Serializer<ros::Time> : detail::TimeSerializer<ros::Time> {};
template <>
struct Serializer<ros::Duration> : detail::TimeSerializer<ros::Duration> {};

template <typename T, class Allocator>
struct Serializer<std::vector<T, Allocator>> {
  typedef std::vector<T, Allocator> VecType;
  template <typename Stream>
  inline static void write(Stream& stream, const VecType& values) {
    serialize(stream, static_cast<uint32_t>(values.size()));
    detail::write_each(stream, values);
  }
  template <typename Stream>
  inline static void read(Stream& stream, VecType& values) {
    uint32_t size = 0;
    deserialize(stream, size);
    values.resize(size);
    detail::read_each(stream, values);
  }
  inline static uint32_t serializedLength(const VecType& values) {
    return 4 + detail::length_of_each(values);
  }
};

template <typename T, size_t N>
struct Serializer<boost::array<T, N>> {
  typedef boost::array<T, N> ArrayType;
  template <typename Stream>
  inline static void write(Stream& stream, const ArrayType& values) {
    detail::write_each(stream, values);
  }
  template <typename Stream>
  inline static void read(Stream& stream, ArrayType& values) {
    detail::read_each(stream, values);
  }
  inline static uint32_t serializedLength(const ArrayType& values) {
    return detail::length_of_each(values);
  }
};

template <typename T, typename Stream>
inline void serialize(Stream& stream, const T& t) {
  Serializer<T>::write(stream, t);
}
template <typename T, typename Stream>
inline void deserialize(Stream& stream, T& t) {
  Serializer<T>::read(stream, t);
}
template <typename T>
inline uint32_t serializationLength(const T& t) {
  return Serializer<T>::serializedLength(t);
}

template <typename T, class Allocator, typename Stream>
inline void serialize(Stream& stream, const std::vector<T, Allocator>& t) {
  Serializer<std::vector<T, Allocator>>::write(stream, t);
}
template <typename T, class Allocator, typename Stream>
inline void deserialize(Stream& stream, std::vector<T, Allocator>& t) {
  Serializer<std::vector<T, Allocator>>::read(stream, t);
}

template <typename M>
inline SerializedMessage serializeMessage(const M& message) {
  SerializedMessage made;
  const uint32_t size = serializationLength(message);
  made.num_bytes = size + 4;
  made.buf.reset(new uint8_t[made.num_bytes]);
  OStream stream(made.buf.get(), static_cast<uint32_t>(made.num_bytes));
  serialize(stream, size);
  made.message_start = stream.getData();
  serialize(stream, message);
  return made;
}

template <typename M>
inline SerializedMessage serializeServiceResponse(bool ok, const M& message) {
  SerializedMessage made;
  const uint32_t size = ok ? serializationLength(message) : serializationLength(std::string());
  made.num_bytes = ok ? size + 5 : 5;
  made.buf.reset(new uint8_t[made.num_bytes]);
  OStream stream(made.buf.get(), static_cast<uint32_t>(made.num_bytes));
  serialize(stream, static_cast<uint8_t>(ok));
  if (ok) {
    serialize(stream, size);
    made.message_start = stream.getData();
    serialize(stream, message);
  } else {
    serialize(stream, static_cast<uint32_t>(0));
  }
  return made;
}

template <typename M>
inline void deserializeMessage(const SerializedMessage& m, M& message) {
  IStream stream(m.message_start,
                 static_cast<uint32_t>(m.num_bytes - (m.message_start - m.buf.get())));
  deserialize(stream, message);
}

// Run before a message is read; users specialise it to give their class a memory of its own.
template <typename M>
struct PreDeserializeParams {
  boost::shared_ptr<M> message;
  boost::shared_ptr<std::map<std::string, std::string>> connection_header;
};
template <typename M>
struct PreDeserialize {
  static void notify(const PreDeserializeParams<M>&) {}
};

}  // namespace serialization
}  // namespace ros
