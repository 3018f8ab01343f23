#pragma once
// A message of any type, as ROS 1's bytes.

#include <ros/ros.h>
#include <topic_tools/macros.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace topic_tools {

/// A shape shifter was taken for a type that it is not.
class ShapeShifterException : public ros::Exception {
 public:
  ShapeShifterException(const std::string& message) : ros::Exception(message) {}
};

class TOPIC_TOOLS_DECL ShapeShifter {
 public:
  typedef boost::shared_ptr<ShapeShifter> Ptr;
  typedef boost::shared_ptr<ShapeShifter const> ConstPtr;

  static bool uses_old_API_;

  ShapeShifter() : typed_(false) {}
  virtual ~ShapeShifter() {}

  std::string const& getDataType() const { return datatype_; }
  std::string const& getMD5Sum() const { return md5_; }
  std::string const& getMessageDefinition() const { return definition_; }

  void morph(const std::string& md5sum, const std::string& datatype,
             const std::string& message_definition, const std::string& latching) {
    md5_ = md5sum;
    datatype_ = datatype;
    definition_ = message_definition;
    latching_ = latching;
    typed_ = md5_ != "*";
  }
  ros::Publisher advertise(
      ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size, bool latch = false,
      const ros::SubscriberStatusCallback& connect_cb = ros::SubscriberStatusCallback()) const {
    ros::AdvertiseOptions options(topic, queue_size, md5_, datatype_, definition_, connect_cb);
    options.latch = latch;
    return nh.advertise(options);
  }

  /// The message of a type; throws where it is another one.
  template <class M>
  boost::shared_ptr<M> instantiate() const {
    if (!typed_)
      throw ShapeShifterException("Tried to instantiate message from an untyped ShapeShifter.");
    if (ros::message_traits::datatype<M>() != getDataType())
      throw ShapeShifterException("Tried to instantiate message without matching datatype: it is " +
                                  getDataType() + ", not " + ros::message_traits::datatype<M>());
    if (ros::message_traits::md5sum<M>() != getMD5Sum())
      throw ShapeShifterException("Tried to instantiate message without matching md5sum: it is " +
                                  getMD5Sum() + ", not " + ros::message_traits::md5sum<M>());
    const boost::shared_ptr<M> made = boost::make_shared<M>();
    ros::serialization::IStream stream(const_cast<uint8_t*>(bytes_.data()), size());
    ros::serialization::deserialize(stream, *made);
    return made;
  }

  template <typename Stream>
  void write(Stream& stream) const {
    if (!bytes_.empty()) std::memcpy(stream.advance(size()), bytes_.data(), bytes_.size());
  }
  template <typename Stream>
  void read(Stream& stream) {
    const uint32_t length = stream.getLength();
    const uint8_t* const data = stream.getData();
    bytes_.assign(data, data + length);
    stream.advance(length);
  }
  uint32_t size() const { return static_cast<uint32_t>(bytes_.size()); }
  const uint8_t* raw_data() const { return bytes_.data(); }

  /// Gazelle's: takes what a subscription has brought.
  void take(std::vector<uint8_t> bytes) { bytes_.swap(bytes); }

 private:
  std::string md5_, datatype_, definition_, latching_;
  bool typed_;
  std::vector<uint8_t> bytes_;
};
typedef boost::shared_ptr<ShapeShifter> ShapeShifterPtr;
typedef boost::shared_ptr<ShapeShifter const> ShapeShifterConstPtr;

}  // namespace topic_tools

namespace ros {

namespace message_traits {
template <>
struct IsMessage<topic_tools::ShapeShifter> : TrueType {};
template <>
struct IsMessage<const topic_tools::ShapeShifter> : TrueType {};

template <>
struct MD5Sum<topic_tools::ShapeShifter> {
  static const char* value(const topic_tools::ShapeShifter& m) { return m.getMD5Sum().c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct DataType<topic_tools::ShapeShifter> {
  static const char* value(const topic_tools::ShapeShifter& m) { return m.getDataType().c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct Definition<topic_tools::ShapeShifter> {
  static const char* value(const topic_tools::ShapeShifter& m) {
    return m.getMessageDefinition().c_str();
  }
  static const char* value() { return ""; }
};
}  // namespace message_traits

namespace serialization {
template <>
struct Serializer<topic_tools::ShapeShifter> {
  template <typename Stream>
  inline static void write(Stream& stream, const topic_tools::ShapeShifter& m) {
    m.write(stream);
  }
  template <typename Stream>
  inline static void read(Stream& stream, topic_tools::ShapeShifter& m) {
    m.read(stream);
  }
  inline static uint32_t serializedLength(const topic_tools::ShapeShifter& m) { return m.size(); }
};

template <>
struct PreDeserialize<topic_tools::ShapeShifter> {
  static void notify(const PreDeserializeParams<topic_tools::ShapeShifter>& params) {
    M_string& header = *params.connection_header;
    params.message->morph(header["md5sum"], header["type"], header["message_definition"],
                          header["latching"]);
  }
};
}  // namespace serialization

namespace detail {
/// Any type: a subscription without a class.
template <>
struct ForeignMessage<topic_tools::ShapeShifter> {
  static const gazelle::MessageType* type() { return 0; }
  template <class Create>
  static VoidConstPtr receive(const gazelle::Delivered& delivered,
                              const boost::shared_ptr<M_string>& header, Create& create) {
    const boost::shared_ptr<topic_tools::ShapeShifter> message = create();
    message->morph((*header)["md5sum"], (*header)["type"], (*header)["message_definition"],
                   (*header)["latching"]);
    const gazelle::MessageType* const native = delivered.type();
    if (native && native->layout && native->is_ros1 && delivered.has_object()) {
      std::vector<uint8_t> bytes;
      gazelle::encode_ros1(*native->layout, delivered.object(*native).get(), bytes);
      message->take(std::move(bytes));
    } else {
      const gazelle::Bytes cdr = delivered.cdr();
      message->take(ros1FromCdr(delivered.type_name(), "", cdr.data(), cdr.size()));
    }
    return message;
  }
};
}  // namespace detail

}  // namespace ros
