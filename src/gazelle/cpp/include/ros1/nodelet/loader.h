#pragma once

#include <nodelet/nodeletdecl.h>
#include <ros/ros.h>

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace nodelet {

class Nodelet;
typedef std::map<std::string, std::string> M_string;
typedef std::vector<std::string> V_string;

/// Loads nodelets into this process and gives them threads.
class NODELETLIB_DECL Loader {
 public:
  /// With services ~load_nodelet, ~unload_nodelet and ~list of this node.
  Loader(bool provide_ros_api = true);
  Loader(const ros::NodeHandle& server_nh);
  /// Makes nodelets by a function, without plugins.
  Loader(const boost::function<boost::shared_ptr<Nodelet>(const std::string& lookup_name)>&
             create_instance);
  ~Loader();

  bool load(const std::string& name, const std::string& type, const M_string& remappings,
            const V_string& my_argv);
  bool unload(const std::string& name);
  bool clear();
  std::vector<std::string> listLoadedNodelets();

 private:
  Loader(const Loader&);
  Loader& operator=(const Loader&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nodelet
