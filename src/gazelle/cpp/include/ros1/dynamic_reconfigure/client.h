// Sees and changes the parameters of another node that has a dynamic_reconfigure::Server.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

#include <boost/function.hpp>

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/console.h>
#include <ros/node_handle.h>

namespace dynamic_reconfigure {

template <class ConfigType>
class Client {
 public:
  typedef boost::function<void(const ConfigType&)> ConfigurationCallback;
  typedef boost::function<void(const ConfigDescription&)> DescriptionCallback;

  explicit Client(const std::string& name,
                  const ConfigurationCallback config_callback = ConfigurationCallback(),
                  const DescriptionCallback description_callback = DescriptionCallback())
      : Client(name, ros::NodeHandle(name), config_callback, description_callback) {}
  Client(const std::string& name, const ros::NodeHandle& nh,
         const ConfigurationCallback config_callback = ConfigurationCallback(),
         const DescriptionCallback description_callback = DescriptionCallback())
      : name_(name),
        node_handle_(nh),
        config_callback_(config_callback),
        description_callback_(description_callback) {
    set_service_ = node_handle_.serviceClient<Reconfigure>("set_parameters");
    config_subscriber_ =
        node_handle_.subscribe("parameter_updates", 1, &Client::configurationCallback, this);
    description_subscriber_ =
        node_handle_.subscribe("parameter_descriptions", 1, &Client::descriptionCallback, this);
  }

  void setConfigurationCallback(const ConfigurationCallback& callback) {
    std::unique_lock<std::mutex> lock(mutex_);
    config_callback_ = callback;
  }
  void setDescriptionCallback(const DescriptionCallback& callback) {
    std::unique_lock<std::mutex> lock(mutex_);
    description_callback_ = callback;
  }

  // Replaces the values by those that the server took over.
  bool setConfiguration(ConfigType& configuration) {
    {
      // Who asks for the values afterwards gets those that the change leads to.
      std::unique_lock<std::mutex> lock(mutex_);
      has_config_ = false;
    }
    Reconfigure service;
    configuration.__toMessage__(service.request.config);
    if (!set_service_.call(service)) {
      ROS_WARN("Could not set configuration");
      return false;
    }
    configuration.__fromMessage__(service.response.config);
    return true;
  }
  bool setConfiguration(const ConfigType& configuration) {
    ConfigType copy = configuration;
    return setConfiguration(copy);
  }

  // Waits for the first values for that long, for ever where it is zero.
  bool getCurrentConfiguration(ConfigType& configuration,
                               const ros::Duration& timeout = ros::Duration(0)) {
    if (!wait(has_config_, timeout)) return false;
    std::unique_lock<std::mutex> lock(mutex_);
    configuration = config_;
    return true;
  }
  bool getDefaultConfiguration(ConfigType& configuration,
                               const ros::Duration& timeout = ros::Duration(0)) {
    return described(configuration, &ConfigDescription::dflt, timeout);
  }
  bool getMinConfiguration(ConfigType& configuration,
                           const ros::Duration& timeout = ros::Duration(0)) {
    return described(configuration, &ConfigDescription::min, timeout);
  }
  bool getMaxConfiguration(ConfigType& configuration,
                           const ros::Duration& timeout = ros::Duration(0)) {
    return described(configuration, &ConfigDescription::max, timeout);
  }

  std::string getName() const { return name_; }

 private:
  template <class Part>
  bool described(ConfigType& configuration, Part part, const ros::Duration& timeout) {
    if (!wait(has_description_, timeout)) return false;
    std::unique_lock<std::mutex> lock(mutex_);
    configuration.__fromMessage__(description_.*part);
    return true;
  }

  bool wait(const bool& is_there, const ros::Duration& timeout) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout.toSec());
    std::unique_lock<std::mutex> lock(mutex_);
    while (!is_there) {
      if (!ros::ok() || (!timeout.isZero() && ros::WallTime::now() > end)) return false;
      condition_.wait_for(lock, std::chrono::milliseconds(50));
    }
    return true;
  }

  void configurationCallback(const Config& message) {
    std::unique_lock<std::mutex> lock(mutex_);
    has_config_ = true;
    config_.__fromMessage__(message);
    condition_.notify_all();
    const ConfigurationCallback callback = config_callback_;
    const ConfigType config = config_;
    lock.unlock();
    if (callback) callback(config);
  }

  void descriptionCallback(const ConfigDescription& message) {
    std::unique_lock<std::mutex> lock(mutex_);
    has_description_ = true;
    description_ = message;
    condition_.notify_all();
    const DescriptionCallback callback = description_callback_;
    lock.unlock();
    if (callback) callback(message);
  }

  std::string name_;
  ros::NodeHandle node_handle_;
  ros::ServiceClient set_service_;
  ros::Subscriber config_subscriber_;
  ros::Subscriber description_subscriber_;
  ConfigurationCallback config_callback_;
  DescriptionCallback description_callback_;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool has_config_ = false;
  bool has_description_ = false;
  ConfigType config_{};
  ConfigDescription description_;
};

}  // namespace dynamic_reconfigure
