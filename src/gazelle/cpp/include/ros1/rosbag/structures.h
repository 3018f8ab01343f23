#pragma once

#include <ros/datatypes.h>
#include <ros/time.h>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <string>

namespace rosbag {

/// Whose messages these are.
struct ConnectionInfo {
  ConnectionInfo() : id(-1) {}
  uint32_t id;
  std::string topic, datatype, md5sum, msg_def;
  boost::shared_ptr<ros::M_string> header;
};

/// Where a message is in its bag.
struct IndexEntry {
  ros::Time time;
  uint64_t chunk_pos;
  uint32_t offset;
  bool operator<(IndexEntry const& other) const { return time < other.time; }
};

}  // namespace rosbag
