#pragma once
// Keeps the calibration of a camera: loads it by URL, and takes new ones by the service
// set_camera_info.

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/SetCameraInfo.h>

#include <mutex>
#include <string>

namespace camera_info_manager {

class ROS_HELPER_EXPORT CameraInfoManager {
 public:
  CameraInfoManager(ros::NodeHandle nh, const std::string& cname = "camera",
                    const std::string& url = "");
  virtual ~CameraInfoManager() {}

  /// Loaded when it is first asked for; empty where there is none.
  virtual sensor_msgs::CameraInfo getCameraInfo(void);
  virtual bool isCalibrated(void);
  virtual bool loadCameraInfo(const std::string& url);
  /// ${NAME} and ${ROS_HOME} filled in.
  virtual std::string resolveURL(const std::string& url, const std::string& cname);
  virtual bool setCameraName(const std::string& cname);
  virtual bool setCameraInfo(const sensor_msgs::CameraInfo& camera_info);
  virtual bool validateURL(const std::string& url);

 protected:
  virtual std::string getPackageFileName(const std::string& url);
  virtual bool loadCalibration(const std::string& url, const std::string& cname);
  virtual bool loadCalibrationFile(const std::string& filename, const std::string& cname);
  virtual bool saveCalibration(const sensor_msgs::CameraInfo& new_info, const std::string& url,
                               const std::string& cname);
  virtual bool saveCalibrationFile(const sensor_msgs::CameraInfo& new_info,
                                   const std::string& filename, const std::string& cname);

  enum url_type_t {
    URL_empty = 0,
    URL_file,
    URL_package,
    URL_invalid,
    URL_flash,
  };
  url_type_t parseURL(const std::string& resolved_url);

 private:
  bool onSetCameraInfo(sensor_msgs::SetCameraInfo::Request& request,
                       sensor_msgs::SetCameraInfo::Response& response);

  std::mutex mutex_;
  ros::NodeHandle nh_;
  ros::ServiceServer info_service_;
  std::string camera_name_, url_;
  sensor_msgs::CameraInfo cam_info_;
  bool loaded_cam_info_ = false;
};

}  // namespace camera_info_manager
