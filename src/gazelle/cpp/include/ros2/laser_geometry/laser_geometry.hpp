// Laser scans as point clouds, in their own frame or in another.
#pragma once

#include <string>
#include <vector>

#include "gazelle/laser_projection.hpp"
#include "sensor_msgs/msg/laser_scan.hpp"
#include "sensor_msgs/msg/point_cloud2.hpp"
#include "tf2/buffer_core.hpp"
#include "tf2_ros/buffer_interface.hpp"

namespace laser_geometry {

namespace channel_option = gazelle::laser_channel;

class LaserProjection {
 public:
  void projectLaser(const sensor_msgs::msg::LaserScan& scan_in,
                    sensor_msgs::msg::PointCloud2& cloud_out, double range_cutoff = -1.0,
                    int channel_options = channel_option::Default) {
    gazelle::laser_cloud2(scan_in, gazelle::laser_points(scan_in, range_cutoff), channel_options,
                          cloud_out);
  }

  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::msg::LaserScan& scan_in,
                                      sensor_msgs::msg::PointCloud2& cloud_out, tf2::BufferCore& tf,
                                      double range_cutoff = -1.0,
                                      int channel_options = channel_option::Default) {
    const std::string& source = scan_in.header.frame_id;
    finish(target_frame, scan_in, cloud_out, range_cutoff, channel_options,
           tf.lookupTransform(target_frame, source, start_of(scan_in)),
           tf.lookupTransform(target_frame, source, end_of(scan_in)));
  }
  // By way of a frame that stands still while the sensor and the target move.
  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::msg::LaserScan& scan_in,
                                      sensor_msgs::msg::PointCloud2& cloud_out,
                                      const std::string& fixed_frame, tf2::BufferCore& tf,
                                      double range_cutoff = -1.0,
                                      int channel_options = channel_option::Default) {
    const std::string& source = scan_in.header.frame_id;
    const tf2::TimePoint start = start_of(scan_in), end = end_of(scan_in);
    finish(target_frame, scan_in, cloud_out, range_cutoff, channel_options,
           tf.lookupTransform(target_frame, start, source, start, fixed_frame),
           tf.lookupTransform(target_frame, start, source, end, fixed_frame));
  }

 private:
  static tf2::TimePoint start_of(const sensor_msgs::msg::LaserScan& scan) {
    return tf2_ros::fromMsg(scan.header.stamp);
  }
  static tf2::TimePoint end_of(const sensor_msgs::msg::LaserScan& scan) {
    if (scan.ranges.empty()) return start_of(scan);
    return start_of(scan) + tf2::durationFromSec(static_cast<double>(scan.ranges.size() - 1) *
                                                 static_cast<double>(scan.time_increment));
  }
  static void finish(const std::string& target, const sensor_msgs::msg::LaserScan& scan,
                     sensor_msgs::msg::PointCloud2& cloud, double range_cutoff, int channels,
                     const geometry_msgs::msg::TransformStamped& first,
                     const geometry_msgs::msg::TransformStamped& last) {
    std::vector<gazelle::LaserPoint> points = gazelle::laser_points(scan, range_cutoff);
    const auto &p = first.transform.translation, &r = last.transform.translation;
    const auto &q = first.transform.rotation, &s = last.transform.rotation;
    gazelle::move_laser_points(points, scan.ranges.size(), tf2::Quaternion(q.x, q.y, q.z, q.w),
                               tf2::Vector3(p.x, p.y, p.z), tf2::Quaternion(s.x, s.y, s.z, s.w),
                               tf2::Vector3(r.x, r.y, r.z));
    gazelle::laser_cloud2(scan, points, channels, cloud);
    cloud.header.frame_id = target;
  }
};

}  // namespace laser_geometry
