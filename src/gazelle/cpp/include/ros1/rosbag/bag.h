#pragma once
// Bags of ROS 1 (format 2.0).

#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>
#include <rosbag/constants.h>
#include <rosbag/exceptions.h>
#include <rosbag/macros.h>
#include <rosbag/structures.h>

#include <boost/shared_ptr.hpp>
#include <memory>
#include <string>
#include <vector>

namespace rosbag {

namespace bagmode {
enum BagMode { Write = 1, Read = 2, Append = 4 };
}
typedef bagmode::BagMode BagMode;

class MessageInstance;
class View;

class ROSBAG_STORAGE_DECL Bag {
 public:
  Bag();
  explicit Bag(std::string const& filename, uint32_t mode = bagmode::Read);
  ~Bag();
  Bag(Bag&& other);
  Bag& operator=(Bag&& other);
  Bag(Bag const&) = delete;
  Bag& operator=(Bag const&) = delete;

  /// Throws BagIOException, BagFormatException, BagUnindexedException.
  void open(std::string const& filename, uint32_t mode = bagmode::Read);
  void close();
  std::string getFileName() const;
  BagMode getMode() const;
  uint32_t getMajorVersion() const { return 2; }
  uint32_t getMinorVersion() const { return 0; }
  uint64_t getSize() const;
  void setCompression(CompressionType compression);
  CompressionType getCompression() const;
  void setChunkThreshold(uint32_t chunk_threshold);
  uint32_t getChunkThreshold() const;
  bool isOpen() const;
  void swap(Bag& other);

  template <class T>
  void write(std::string const& topic, ros::MessageEvent<T> const& event) {
    write(topic, event.getReceiptTime(), *event.getMessage(), event.getConnectionHeaderPtr());
  }
  template <class T>
  void write(
      std::string const& topic, ros::Time const& time, T const& message,
      boost::shared_ptr<ros::M_string> connection_header = boost::shared_ptr<ros::M_string>()) {
    std::vector<uint8_t> bytes(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, message);
    writeBytes(topic, time, ros::message_traits::datatype(message),
               ros::message_traits::md5sum(message), ros::message_traits::definition(message),
               connection_header, bytes);
  }
  template <class T>
  void write(
      std::string const& topic, ros::Time const& time, boost::shared_ptr<T const> const& message,
      boost::shared_ptr<ros::M_string> connection_header = boost::shared_ptr<ros::M_string>()) {
    write(topic, time, *message, connection_header);
  }
  template <class T>
  void write(
      std::string const& topic, ros::Time const& time, boost::shared_ptr<T> const& message,
      boost::shared_ptr<ros::M_string> connection_header = boost::shared_ptr<ros::M_string>()) {
    write(topic, time, *message, connection_header);
  }

  /// Gazelle's: a message as ROS 1's bytes.
  void writeBytes(std::string const& topic, ros::Time const& time, std::string const& datatype,
                  std::string const& md5sum, std::string const& definition,
                  boost::shared_ptr<ros::M_string> const& header,
                  std::vector<uint8_t> const& bytes);

  struct Impl;

 private:
  friend class View;
  friend class MessageInstance;
  std::shared_ptr<Impl> impl_;
};

}  // namespace rosbag
