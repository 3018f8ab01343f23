// What the core knows of a type of messages: one static object a type, made by
// gazelle::message_type<M>() of <gazelle/message.hpp>.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <typeinfo>
#include <vector>

namespace gazelle {

struct MessageType {
  const char *name;        // "std_msgs/msg/String"
  const char *ros1_name;   // "std_msgs/String"
  const char *md5;         // of ROS 1
  const char *definition;  // the text, with those of the types in it behind
  const std::type_info *native;
  bool is_ros1;
  // CDR with its header of four bytes, appended to nothing: the vector is replaced.
  void (*encode)(const void *message, std::vector<std::uint8_t> &cdr);
  // Throws gazelle::Error.
  std::shared_ptr<void> (*decode)(const std::uint8_t *cdr, std::size_t size);
};

// The same for services; requests and responses travel as CDR of their own types.
struct ServiceType {
  const char *name;       // "std_srvs/srv/Empty"
  const char *ros1_name;  // "std_srvs/Empty"
  const char *md5;
  const char *definition;  // request, a line of ---, response; those of the types in it behind
  const MessageType *request;
  const MessageType *response;
};

}  // namespace gazelle
