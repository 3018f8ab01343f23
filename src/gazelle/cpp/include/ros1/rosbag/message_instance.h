#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/macros.h>
#include <rosbag/structures.h>

#include <cstring>

namespace rosbag {

/// A message of a bag; it is read when it is asked for.
class ROSBAG_STORAGE_DECL MessageInstance {
 public:
  ros::Time const& getTime() const { return entry_.time; }
  std::string const& getTopic() const { return connection_->topic; }
  std::string const& getDataType() const { return connection_->datatype; }
  std::string const& getMD5Sum() const { return connection_->md5sum; }
  std::string const& getMessageDefinition() const { return connection_->msg_def; }
  boost::shared_ptr<ros::M_string> getConnectionHeader() const { return connection_->header; }
  std::string getCallerId() const { return headerField("callerid", "unknown"); }
  bool isLatching() const { return headerField("latching", "0") == "1"; }

  /// Whether it is of a type.
  template <class T>
  bool isType() const {
    const char* const md5sum = ros::message_traits::md5sum<T>();
    return std::strcmp(md5sum, "*") == 0 || getMD5Sum() == md5sum;
  }
  /// The message; null where it is of another type.
  template <class T>
  boost::shared_ptr<T> instantiate() const {
    if (!isType<T>()) return boost::shared_ptr<T>();
    const boost::shared_ptr<T> message = boost::make_shared<T>();
    std::vector<uint8_t> bytes = read();
    ros::serialization::PreDeserializeParams<T> params;
    params.message = message;
    params.connection_header = connection_->header;
    ros::serialization::PreDeserialize<T>::notify(params);
    ros::serialization::IStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
    ros::serialization::deserialize(stream, *message);
    return message;
  }
  /// Writes the bytes.
  template <typename Stream>
  void write(Stream& stream) const {
    const std::vector<uint8_t> bytes = read();
    if (!bytes.empty())
      std::memcpy(stream.advance(static_cast<uint32_t>(bytes.size())), bytes.data(), bytes.size());
  }
  uint32_t size() const;

 private:
  friend class View;
  MessageInstance(ConnectionInfo const* connection, IndexEntry const& entry,
                  std::shared_ptr<Bag::Impl> const& bag)
      : connection_(connection), entry_(entry), bag_(bag) {}
  std::string headerField(const char* name, const char* fallback) const {
    if (!connection_->header) return fallback;
    const ros::M_string::const_iterator found = connection_->header->find(name);
    return found == connection_->header->end() ? fallback : found->second;
  }
  std::vector<uint8_t> read() const;

  ConnectionInfo const* connection_;
  IndexEntry entry_;
  std::shared_ptr<Bag::Impl> bag_;
};

}  // namespace rosbag

namespace ros {

namespace message_traits {
template <>
struct MD5Sum<rosbag::MessageInstance> {
  static const char* value(const rosbag::MessageInstance& m) { return m.getMD5Sum().c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct DataType<rosbag::MessageInstance> {
  static const char* value(const rosbag::MessageInstance& m) { return m.getDataType().c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct Definition<rosbag::MessageInstance> {
  static const char* value(const rosbag::MessageInstance& m) {
    return m.getMessageDefinition().c_str();
  }
  static const char* value() { return ""; }
};
}  // namespace message_traits

namespace serialization {
template <>
struct Serializer<rosbag::MessageInstance> {
  template <typename Stream>
  inline static void write(Stream& stream, const rosbag::MessageInstance& m) {
    m.write(stream);
  }
  inline static uint32_t serializedLength(const rosbag::MessageInstance& m) { return m.size(); }
};
}  // namespace serialization

}  // namespace ros
