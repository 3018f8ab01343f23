// Laser scans as point clouds, in their own frame or in another.
#pragma once

#include <string>

#include "gazelle/laser_projection.hpp"
#include "sensor_msgs/LaserScan.h"
#include "sensor_msgs/PointCloud.h"
#include "sensor_msgs/PointCloud2.h"
#include "tf/tf.h"
#include "tf2/buffer_core.h"

namespace laser_geometry {

namespace channel_option = gazelle::laser_channel;

class LaserProjection {
 public:
  void projectLaser(const sensor_msgs::LaserScan& scan_in, sensor_msgs::PointCloud& cloud_out,
                    double range_cutoff = -1.0, int channel_options = channel_option::Default) {
    gazelle::laser_cloud(scan_in, gazelle::laser_points(scan_in, range_cutoff), channel_options,
                         cloud_out);
  }
  void projectLaser(const sensor_msgs::LaserScan& scan_in, sensor_msgs::PointCloud2& cloud_out,
                    double range_cutoff = -1.0, int channel_options = channel_option::Default) {
    gazelle::laser_cloud2(scan_in, gazelle::laser_points(scan_in, range_cutoff), channel_options,
                          cloud_out);
  }

  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud& cloud_out, tf::Transformer& tf,
                                      double range_cutoff,
                                      int channel_options = channel_option::Default) {
    gazelle::laser_cloud(scan_in, moved(target_frame, scan_in, *tf.getTF2BufferPtr(), range_cutoff),
                         channel_options, cloud_out);
    cloud_out.header.frame_id = target_frame;
  }
  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud& cloud_out, tf::Transformer& tf,
                                      int channel_options = channel_option::Default) {
    transformLaserScanToPointCloud(target_frame, scan_in, cloud_out, tf, -1.0, channel_options);
  }
  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud2& cloud_out, tf::Transformer& tf,
                                      double range_cutoff = -1.0,
                                      int channel_options = channel_option::Default) {
    transformLaserScanToPointCloud(target_frame, scan_in, cloud_out, *tf.getTF2BufferPtr(),
                                   range_cutoff, channel_options);
  }
  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud2& cloud_out, tf2::BufferCore& tf,
                                      double range_cutoff = -1.0,
                                      int channel_options = channel_option::Default) {
    gazelle::laser_cloud2(scan_in, moved(target_frame, scan_in, tf, range_cutoff), channel_options,
                          cloud_out);
    cloud_out.header.frame_id = target_frame;
  }
  // By way of a frame that stands still while the sensor and the target move.
  void transformLaserScanToPointCloud(const std::string& target_frame,
                                      const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud2& cloud_out,
                                      const std::string& fixed_frame, tf2::BufferCore& tf,
                                      double range_cutoff = -1.0,
                                      int channel_options = channel_option::Default) {
    const ros::Time start = scan_in.header.stamp, end = end_of(scan_in);
    const std::string source = tf::strip_leading_slash(scan_in.header.frame_id);
    gazelle::laser_cloud2(scan_in,
                          moved(scan_in, range_cutoff,
                                tf.lookupTransform(target_frame, start, source, start, fixed_frame),
                                tf.lookupTransform(target_frame, start, source, end, fixed_frame)),
                          channel_options, cloud_out);
    cloud_out.header.frame_id = target_frame;
  }

 private:
  using Points = std::vector<gazelle::LaserPoint>;

  static ros::Time end_of(const sensor_msgs::LaserScan& scan) {
    if (scan.ranges.empty()) return scan.header.stamp;
    return scan.header.stamp + ros::Duration(static_cast<double>(scan.ranges.size() - 1) *
                                             static_cast<double>(scan.time_increment));
  }
  static Points moved(const std::string& target, const sensor_msgs::LaserScan& scan,
                      const tf2::BufferCore& tf, double range_cutoff) {
    const std::string source = tf::strip_leading_slash(scan.header.frame_id);
    const std::string frame = tf::strip_leading_slash(target);
    return moved(scan, range_cutoff, tf.lookupTransform(frame, source, scan.header.stamp),
                 tf.lookupTransform(frame, source, end_of(scan)));
  }
  static Points moved(const sensor_msgs::LaserScan& scan, double range_cutoff,
                      const geometry_msgs::TransformStamped& first,
                      const geometry_msgs::TransformStamped& last) {
    Points points = gazelle::laser_points(scan, range_cutoff);
    const auto &p = first.transform.translation, &r = last.transform.translation;
    const auto &q = first.transform.rotation, &s = last.transform.rotation;
    gazelle::move_laser_points(points, scan.ranges.size(), tf2::Quaternion(q.x, q.y, q.z, q.w),
                               tf2::Vector3(p.x, p.y, p.z), tf2::Quaternion(s.x, s.y, s.z, s.w),
                               tf2::Vector3(r.x, r.y, r.z));
    return points;
  }
};

}  // namespace laser_geometry
