// Laser scans as points, for both ROSes' laser_geometry.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "tf2/LinearMath/Transform.h"

namespace gazelle {

// What a cloud gets besides x, y and z, as a sum.
namespace laser_channel {
enum ChannelOption {
  None = 0x00,
  Intensity = 0x01,
  Index = 0x02,
  Distance = 0x04,
  Timestamp = 0x08,
  Viewpoint = 0x10,
  Default = Intensity | Index
};
}  // namespace laser_channel

// A beam that hit something.
struct LaserPoint {
  std::size_t index = 0;
  double range = 0.0;
  tf2::Vector3 position{0.0, 0.0, 0.0};
  tf2::Vector3 viewpoint{0.0, 0.0, 0.0};
};

// Beams from the least range up to the cutoff, which is the greatest where negative.
template <class Scan>
std::vector<LaserPoint> laser_points(const Scan& scan, double range_cutoff) {
  const double limit = range_cutoff < 0 ? static_cast<double>(scan.range_max) : range_cutoff;
  std::vector<LaserPoint> points;
  points.reserve(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range < limit && range >= scan.range_min)) continue;  // not a number is neither
    const double angle =
        static_cast<double>(scan.angle_min) + static_cast<double>(i) * scan.angle_increment;
    LaserPoint point;
    point.index = i;
    point.range = range;
    point.position = tf2::Vector3(range * std::cos(angle), range * std::sin(angle), 0.0);
    points.push_back(point);
  }
  return points;
}

// Moves points as the sensor moved while it scanned: from the transform at the first beam to that
// at the last one.
inline void move_laser_points(std::vector<LaserPoint>& points, std::size_t beams,
                              const tf2::Quaternion& first_rotation,
                              const tf2::Vector3& first_origin,
                              const tf2::Quaternion& last_rotation,
                              const tf2::Vector3& last_origin) {
  const double last = beams > 1 ? static_cast<double>(beams - 1) : 1.0;
  for (LaserPoint& point : points) {
    const double ratio = static_cast<double>(point.index) / last;
    tf2::Vector3 origin;
    origin.setInterpolate3(first_origin, last_origin, ratio);
    const tf2::Transform here(tf2::slerp(first_rotation, last_rotation, ratio), origin);
    point.position = here * point.position;
    point.viewpoint = here * point.viewpoint;
  }
}

template <class Scan, class Cloud>
void laser_cloud2(const Scan& scan, const std::vector<LaserPoint>& points, int channels,
                  Cloud& cloud) {
  using Value = std::function<double(const LaserPoint&)>;
  constexpr std::uint8_t whole = 5, real = 7;  // INT32 and FLOAT32
  struct Column {
    const char* name;
    std::uint8_t datatype;
    Value value;
  };
  std::vector<Column> columns{
      {"x", real, [](const LaserPoint& p) { return p.position.x(); }},
      {"y", real, [](const LaserPoint& p) { return p.position.y(); }},
      {"z", real, [](const LaserPoint& p) { return p.position.z(); }},
  };
  if ((channels & laser_channel::Intensity) != 0 && !scan.intensities.empty())
    columns.push_back({"intensity", real, [&scan](const LaserPoint& p) {
                         return p.index < scan.intensities.size() ? scan.intensities[p.index]
                                                                  : 0.0F;
                       }});
  if ((channels & laser_channel::Index) != 0)
    columns.push_back(
        {"index", whole, [](const LaserPoint& p) { return static_cast<double>(p.index); }});
  if ((channels & laser_channel::Distance) != 0)
    columns.push_back({"distances", real, [](const LaserPoint& p) { return p.range; }});
  if ((channels & laser_channel::Timestamp) != 0)
    columns.push_back({"stamps", real, [&scan](const LaserPoint& p) {
                         return static_cast<double>(p.index) * scan.time_increment;
                       }});
  if ((channels & laser_channel::Viewpoint) != 0) {
    columns.push_back({"vp_x", real, [](const LaserPoint& p) { return p.viewpoint.x(); }});
    columns.push_back({"vp_y", real, [](const LaserPoint& p) { return p.viewpoint.y(); }});
    columns.push_back({"vp_z", real, [](const LaserPoint& p) { return p.viewpoint.z(); }});
  }

  cloud.header = scan.header;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.fields.resize(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    cloud.fields[i].name = columns[i].name;
    cloud.fields[i].offset = static_cast<std::uint32_t>(4 * i);
    cloud.fields[i].datatype = columns[i].datatype;
    cloud.fields[i].count = 1;
  }
  cloud.is_bigendian = false;
  cloud.is_dense = false;
  cloud.point_step = static_cast<std::uint32_t>(4 * columns.size());
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* out = cloud.data.data();
  for (const LaserPoint& point : points) {
    for (const Column& column : columns) {
      const double value = column.value(point);
      if (column.datatype == whole) {
        const std::int32_t number = static_cast<std::int32_t>(value);
        std::memcpy(out, &number, sizeof number);
      } else {
        const float number = static_cast<float>(value);
        std::memcpy(out, &number, sizeof number);
      }
      out += 4;
    }
  }
}

template <class Scan, class Cloud>
void laser_cloud(const Scan& scan, const std::vector<LaserPoint>& points, int channels,
                 Cloud& cloud) {
  cloud.header = scan.header;
  cloud.points.resize(points.size());
  cloud.channels.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.points[i].x = static_cast<float>(points[i].position.x());
    cloud.points[i].y = static_cast<float>(points[i].position.y());
    cloud.points[i].z = static_cast<float>(points[i].position.z());
  }
  const auto add = [&](const char* name, const std::function<float(const LaserPoint&)>& value) {
    cloud.channels.emplace_back();
    cloud.channels.back().name = name;
    for (const LaserPoint& point : points) cloud.channels.back().values.push_back(value(point));
  };
  if ((channels & laser_channel::Intensity) != 0 && !scan.intensities.empty())
    add("intensities", [&scan](const LaserPoint& p) {
      return p.index < scan.intensities.size() ? scan.intensities[p.index] : 0.0F;
    });
  if ((channels & laser_channel::Index) != 0)
    add("index", [](const LaserPoint& p) { return static_cast<float>(p.index); });
  if ((channels & laser_channel::Distance) != 0)
    add("distances", [](const LaserPoint& p) { return static_cast<float>(p.range); });
  if ((channels & laser_channel::Timestamp) != 0)
    add("stamps",
        [&scan](const LaserPoint& p) { return static_cast<float>(p.index) * scan.time_increment; });
}

}  // namespace gazelle
