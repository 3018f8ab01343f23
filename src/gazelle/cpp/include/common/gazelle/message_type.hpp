// What the core knows of a type of messages: one static object a type, made by
// gazelle::message_type<M>() of <gazelle/message.hpp>.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <typeinfo>
#include <vector>

namespace gazelle {

struct Layout;

// A type without its class; one object for each type and library.
struct MessageType {
  const char* name;       // "std_msgs/msg/String"
  const char* ros1_name;  // "std_msgs/String"
  const char* md5;
  const char* hash;
  const char* (*definition)();
  const std::type_info* native;
  bool is_ros1;
  // CDR with its header of four bytes; the vector is replaced.
  void (*encode)(const void* message, std::vector<std::uint8_t>& cdr);
  // Throws gazelle::Error.
  std::shared_ptr<void> (*decode)(const std::uint8_t* cdr, std::size_t size);
  std::shared_ptr<void> (*create)();
  const Layout* layout;  // null where a class has codecs of its own

  // The same class, also where two libraries have an object each.
  bool is_same(const MessageType& other) const {
    return this == &other || *native == *other.native;
  }
};

// The same for services; requests and responses travel as CDR of their own types.
struct ServiceType {
  const char* name;       // "std_srvs/srv/Empty"
  const char* ros1_name;  // "std_srvs/Empty"
  const char* md5;
  const char* hash;
  const MessageType* request;
  const MessageType* response;
};

}  // namespace gazelle
