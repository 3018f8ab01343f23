#pragma once
// Messages of classes that users wrote themselves: ros::message_traits name their type and
// ros::serialization::Serializer reads and writes ROS 1's bytes, which become CDR by the type's
// definition (runtime/roscpp/wire_conversion.cpp).

#include <ros/common.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/subscription_callback_helper.h>
#include <gazelle/core.hpp>

#include <memory>
#include <string>
#include <vector>

namespace ros {
namespace detail {

/// CDR of a type to ROS 1's bytes and back; the definition may be empty where Gazelle knows the
/// type. Throws gazelle::Error.
ROSCPP_DECL std::vector<uint8_t> ros1FromCdr(const std::string& type, const std::string& definition,
                                             const uint8_t* cdr, std::size_t size);
ROSCPP_DECL std::vector<uint8_t> cdrFromRos1(const std::string& type, const std::string& definition,
                                             const uint8_t* bytes, std::size_t size);
/// "std_msgs/String" as "std_msgs/msg/String", which stays what it is.
ROSCPP_DECL std::string ros2TypeName(const std::string& type, const char* folder = "msg");
ROSCPP_DECL std::string ros1TypeName(const std::string& type);
/// The text of a type that Gazelle knows or has met, and its sum.
ROSCPP_DECL const std::string& definitionOf(const std::string& type);
ROSCPP_DECL const std::string& md5Of(const std::string& type);

template <class M>
struct ForeignMessage {
  static const gazelle::MessageType* type() {
    static const std::string name = ros2TypeName(message_traits::datatype<M>());
    static const gazelle::MessageType found = make(name.c_str());
    return &found;
  }

  template <class Create>
  static VoidConstPtr receive(const gazelle::Delivered& delivered,
                              const boost::shared_ptr<M_string>& header, Create& create) {
    const gazelle::Bytes cdr = delivered.cdr();
    std::vector<uint8_t> bytes =
        ros1FromCdr(type()->name, type()->definition(), cdr.data(), cdr.size());
    boost::shared_ptr<M> message = create();
    static_cast<void>(header);
    read(*message, bytes.data(), bytes.size());
    return message;
  }

 private:
  static gazelle::MessageType make(const char* name) {
    gazelle::MessageType made{};
    made.name = name;
    made.ros1_name = message_traits::datatype<M>();
    made.md5 = message_traits::md5sum<M>();
    made.hash = "";
    made.definition = [] { return message_traits::definition<M>(); };
    made.native = &typeid(M);
    made.is_ros1 = true;
    made.encode = [](const void* message, std::vector<uint8_t>& cdr) {
      const M& m = *static_cast<const M*>(message);
      std::vector<uint8_t> bytes(serialization::serializationLength(m));
      serialization::OStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
      serialization::serialize(stream, m);
      cdr = cdrFromRos1(type()->name, type()->definition(), bytes.data(), bytes.size());
    };
    made.decode = [](const uint8_t* cdr, std::size_t size) -> std::shared_ptr<void> {
      std::vector<uint8_t> bytes = ros1FromCdr(type()->name, type()->definition(), cdr, size);
      auto message = std::make_shared<M>();
      read(*message, bytes.data(), bytes.size());
      return message;
    };
    made.create = []() -> std::shared_ptr<void> { return std::make_shared<M>(); };
    return made;
  }

  static void read(M& message, uint8_t* bytes, std::size_t size) {
    serialization::IStream stream(bytes, static_cast<uint32_t>(size));
    serialization::deserialize(stream, message);
  }
};

}  // namespace detail

template <typename P, typename Enabled>
VoidConstPtr SubscriptionCallbackHelperT<P, Enabled>::deserialize(
    const SubscriptionCallbackHelperDeserializeParams& params) {
  NonConstTypePtr message = create_();
  if (!message) return VoidConstPtr();
  serialization::IStream stream(params.buffer, params.length);
  serialization::deserialize(stream, *message);
  return VoidConstPtr(message);
}

}  // namespace ros
