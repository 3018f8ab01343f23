// Point clouds of ROS 1 and of PCL, which must be installed.
#pragma once

#include <pcl/PCLHeader.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/PCLPointField.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>

#include <cstdint>
#include <string>
#include <vector>

#include "ros/time.h"
#include "sensor_msgs/PointCloud2.h"
#include "std_msgs/Header.h"

namespace pcl_conversions {
namespace impl {

inline std::uint64_t microseconds(const ros::Time& stamp) { return stamp.toNSec() / 1000; }
inline ros::Time stamp_of(std::uint64_t us) { return ros::Time().fromNSec(us * 1000); }
inline std::uint32_t sequence(const std_msgs::Header& header) { return header.seq; }
inline void set_sequence(std_msgs::Header& header, std::uint32_t seq) { header.seq = seq; }

}  // namespace impl
}  // namespace pcl_conversions

#define GAZELLE_MSG(package, Name) ::package::Name
#define GAZELLE_STAMP ros::Time
#include "gazelle/pcl_conversions.inc"
#undef GAZELLE_STAMP
#undef GAZELLE_MSG
