#pragma once

#include <ros/time.h>
#include <rosbag/macros.h>
#include <rosbag/structures.h>

#include <algorithm>
#include <boost/function.hpp>
#include <string>
#include <vector>

namespace rosbag {

/// Messages of these topics.
class ROSBAG_STORAGE_DECL TopicQuery {
 public:
  TopicQuery(std::string const& topic) : topics_(1, topic) {}
  TopicQuery(std::vector<std::string> const& topics) : topics_(topics) {}
  bool operator()(ConnectionInfo const* info) const {
    return std::find(topics_.begin(), topics_.end(), info->topic) != topics_.end();
  }

 private:
  std::vector<std::string> topics_;
};

/// Messages of these types.
class ROSBAG_STORAGE_DECL TypeQuery {
 public:
  TypeQuery(std::string const& type) : types_(1, type) {}
  TypeQuery(std::vector<std::string> const& types) : types_(types) {}
  bool operator()(ConnectionInfo const* info) const {
    return std::find(types_.begin(), types_.end(), info->datatype) != types_.end();
  }

 private:
  std::vector<std::string> types_;
};

}  // namespace rosbag
