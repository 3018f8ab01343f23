#pragma once

#include <ros/ros.h>

#include <string>

#include "urdf/urdfdom_compatibility.h"
#include "urdf_model/model.h"

namespace urdf {

// A robot's description, read from a text, a file or a parameter.
class Model : public ModelInterface {
 public:
  bool initString(const std::string& xmlstring);
  bool initFile(const std::string& filename);
  // A parameter, searched for in the namespaces above as well.
  bool initParam(const std::string& param) { return initParamWithNodeHandle(param); }
  bool initParamWithNodeHandle(const std::string& param,
                               const ros::NodeHandle& nh = ros::NodeHandle()) {
    std::string full_name;
    if (!nh.searchParam(param, full_name)) {
      ROS_ERROR("Could not find parameter %s on parameter server", param.c_str());
      return false;
    }
    std::string text;
    if (!nh.getParam(full_name, text)) {
      ROS_ERROR("Could not read parameter %s on parameter server", full_name.c_str());
      return false;
    }
    return initString(text);
  }
};

using ModelSharedPtr = std::shared_ptr<Model>;
using ModelConstSharedPtr = std::shared_ptr<const Model>;

}  // namespace urdf
