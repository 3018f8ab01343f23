#pragma once

#include <string>

namespace rosbag {

/// How chunks of a bag are packed.
namespace compression {
enum CompressionType { Uncompressed = 0, BZ2 = 1, LZ4 = 2 };
}
typedef compression::CompressionType CompressionType;

static const std::string VERSION = "2.0";

}  // namespace rosbag
