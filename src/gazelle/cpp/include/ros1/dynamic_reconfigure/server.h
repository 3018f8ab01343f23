// Offers a node's parameters to be seen and changed while it runs.
#pragma once

#include <exception>
#include <memory>
#include <string>

#include <boost/function.hpp>
#include <boost/thread/recursive_mutex.hpp>

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <gazelle/reconfigure.hpp>

namespace dynamic_reconfigure {

template <class ConfigType>
class Server {
 public:
  typedef boost::function<void(ConfigType&, uint32_t level)> CallbackType;

  explicit Server(const ros::NodeHandle& nh = ros::NodeHandle("~"))
      : node_handle_(nh), mutex_(own_mutex_), own_mutex_warn_(true) {
    init();
  }
  explicit Server(boost::recursive_mutex& mutex, const ros::NodeHandle& nh = ros::NodeHandle("~"))
      : node_handle_(nh), mutex_(mutex), own_mutex_warn_(false) {
    init();
  }

  // The callback hears the present values at once, with every level.
  void setCallback(const CallbackType& callback) {
    boost::recursive_mutex::scoped_lock lock(mutex_);
    callback_ = callback;
    callCallback(config_, ~static_cast<uint32_t>(0));
    updateConfigInternal(config_);
  }
  void clearCallback() {
    boost::recursive_mutex::scoped_lock lock(mutex_);
    callback_.clear();
  }

  // Values that the node has changed by itself; the callback is not called.
  void updateConfig(const ConfigType& config) {
    if (own_mutex_warn_) {
      ROS_WARN(
          "updateConfig() is called on a dynamic_reconfigure::Server that has a mutex of its "
          "own: this can lead to deadlocks. Pass a mutex to the constructor.");
      own_mutex_warn_ = false;
    }
    updateConfigInternal(config);
  }

  void getConfigMax(ConfigType& config) { config = max_; }
  void getConfigMin(ConfigType& config) { config = min_; }
  void getConfigDefault(ConfigType& config) { config = default_; }
  void setConfigMax(const ConfigType& config) {
    max_ = config;
    publishDescription();
  }
  void setConfigMin(const ConfigType& config) {
    min_ = config;
    publishDescription();
  }
  void setConfigDefault(const ConfigType& config) {
    default_ = config;
    publishDescription();
  }

 private:
  void init() {
    min_ = ConfigType::__getMin__();
    max_ = ConfigType::__getMax__();
    default_ = ConfigType::__getDefault__();
    boost::recursive_mutex::scoped_lock lock(mutex_);
    endpoints_.reset(new ::gazelle::reconfigure::Endpoints(
        node_handle_, [this](const Config& request, Config& response) { set(request, response); }));
    publishDescription();
    ConfigType initial = ConfigType::__getDefault__();
    initial.__fromServer__(node_handle_);
    initial.__clamp__();
    updateConfigInternal(initial);
  }

  void publishDescription() {
    ConfigDescription description = ConfigType::__getDescriptionMessage__();
    max_.__toMessage__(description.max);
    min_.__toMessage__(description.min);
    default_.__toMessage__(description.dflt);
    endpoints_->describe(description);
  }

  void set(const Config& request, Config& response) {
    boost::recursive_mutex::scoped_lock lock(mutex_);
    ConfigType changed = config_;
    if (!changed.__fromMessage__(request)) {
      ROS_ERROR("set_parameters: the request holds parameters that this node does not have");
    }
    changed.__clamp__();
    callCallback(changed, config_.__level__(changed));
    updateConfigInternal(changed);
    changed.__toMessage__(response);
  }

  void callCallback(ConfigType& config, uint32_t level) {
    if (!callback_) {
      ROS_DEBUG("setCallback has not been called; a change of parameters is heard by nobody.");
      return;
    }
    try {
      callback_(config, level);
    } catch (const std::exception& error) {
      ROS_WARN("Reconfigure callback failed with exception %s", error.what());
    } catch (...) {
      ROS_WARN("Reconfigure callback failed with unprintable exception.");
    }
  }

  void updateConfigInternal(const ConfigType& config) {
    boost::recursive_mutex::scoped_lock lock(mutex_);
    config_ = config;
    config_.__toServer__(node_handle_);
    Config message;
    config_.__toMessage__(message);
    endpoints_->update(message);
  }

  ros::NodeHandle node_handle_;
  CallbackType callback_;
  ConfigType config_;
  ConfigType min_;
  ConfigType max_;
  ConfigType default_;
  boost::recursive_mutex own_mutex_;
  boost::recursive_mutex& mutex_;
  bool own_mutex_warn_;
  // Last, so that no request comes while the rest goes.
  std::unique_ptr<::gazelle::reconfigure::Endpoints> endpoints_;
};

}  // namespace dynamic_reconfigure
