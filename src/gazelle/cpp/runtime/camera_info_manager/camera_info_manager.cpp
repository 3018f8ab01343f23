// Calibrations of cameras.

#include <camera_calibration_parsers/parse.h>
#include <camera_info_manager/camera_info_manager.h>
#include <ros/console.h>
#include <ros/package.h>
#include <sys/stat.h>
#include <gazelle/core.hpp>

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace camera_calibration_parsers {

namespace {

using gazelle::Json;

template <class Numbers>
void fill(Numbers& numbers, const Json& values) {
  for (std::size_t i = 0; i < numbers.size() && i < values.size(); ++i)
    numbers[i] = values[i].as_double();
}

template <class Numbers>
Json listed(const Numbers& numbers) {
  Json values = Json::array();
  for (const double number : numbers) values.push(Json(number));
  return values;
}

}  // namespace

bool parseCalibration(const std::string& buffer, const std::string& format,
                      std::string& camera_name, sensor_msgs::CameraInfo& cam_info) {
  if (format != "yml" && format != "yaml") {
    ROS_ERROR("Calibrations of format '%s' are not read: they are YAML", format.c_str());
    return false;
  }
  try {
    const Json found = gazelle::call("camera_calibration/parse", Json::object({{"text", buffer}}));
    camera_name = found["camera_name"].as_string();
    cam_info.width = static_cast<uint32_t>(found["image_width"].as_int());
    cam_info.height = static_cast<uint32_t>(found["image_height"].as_int());
    cam_info.distortion_model = found["distortion_model"].as_string("plumb_bob");
    cam_info.D.resize(found["D"].size());
    fill(cam_info.D, found["D"]);
    fill(cam_info.K, found["K"]);
    fill(cam_info.R, found["R"]);
    fill(cam_info.P, found["P"]);
    return true;
  } catch (const gazelle::Error& error) {
    ROS_ERROR("The camera calibration cannot be read: %s", error.what());
    return false;
  }
}

bool readCalibration(const std::string& file_name, std::string& camera_name,
                     sensor_msgs::CameraInfo& cam_info) {
  std::ifstream file(file_name);
  if (!file) {
    ROS_ERROR("Unable to open camera calibration file [%s]", file_name.c_str());
    return false;
  }
  std::ostringstream text;
  text << file.rdbuf();
  const std::size_t dot = file_name.rfind('.');
  const std::string format = dot == std::string::npos ? "" : file_name.substr(dot + 1);
  if (parseCalibration(text.str(), format, camera_name, cam_info)) return true;
  ROS_ERROR("Failed to parse camera calibration from file [%s]", file_name.c_str());
  return false;
}

bool writeCalibration(const std::string& file_name, const std::string& camera_name,
                      const sensor_msgs::CameraInfo& cam_info) {
  try {
    const std::string text =
        gazelle::call("camera_calibration/text",
                      Json::object({{"camera_name", camera_name},
                                    {"image_width", cam_info.width},
                                    {"image_height", cam_info.height},
                                    {"distortion_model", cam_info.distortion_model},
                                    {"D", listed(cam_info.D)},
                                    {"K", listed(cam_info.K)},
                                    {"R", listed(cam_info.R)},
                                    {"P", listed(cam_info.P)}}))
            .as_string();
    std::ofstream file(file_name);
    file << text;
    file.close();
    if (file) return true;
    ROS_ERROR("Unable to write camera calibration file [%s]", file_name.c_str());
  } catch (const gazelle::Error& error) {
    ROS_ERROR("The camera calibration cannot be written: %s", error.what());
  }
  return false;
}

}  // namespace camera_calibration_parsers

namespace camera_info_manager {

namespace {

const char kDefaultUrl[] = "file://${ROS_HOME}/camera_info/${NAME}.yaml";

bool isName(const std::string& name) {
  if (name.empty()) return false;
  for (const char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  return true;
}

std::string rosHome() {
  if (const char* const value = std::getenv("ROS_HOME")) return value;
  const char* const home = std::getenv("HOME");
  return std::string(home ? home : "") + "/.ros";
}

// The folder of a file, made where it is not there.
bool makeFolder(const std::string& file_name) {
  for (std::size_t slash = file_name.find('/', 1); slash != std::string::npos;
       slash = file_name.find('/', slash + 1)) {
    struct stat found;
    const std::string folder = file_name.substr(0, slash);
    if (stat(folder.c_str(), &found) != 0 && mkdir(folder.c_str(), 0777) != 0) return false;
  }
  return true;
}

}  // namespace

CameraInfoManager::CameraInfoManager(ros::NodeHandle nh, const std::string& cname,
                                     const std::string& url)
    : nh_(nh), camera_name_(cname), url_(url) {
  info_service_ =
      nh_.advertiseService("set_camera_info", &CameraInfoManager::onSetCameraInfo, this);
}

sensor_msgs::CameraInfo CameraInfoManager::getCameraInfo() {
  for (;;) {
    std::string name, url;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (loaded_cam_info_) return cam_info_;
      loaded_cam_info_ = true;
      name = camera_name_;
      url = url_;
    }
    loadCalibration(url, name);
  }
}

bool CameraInfoManager::isCalibrated() { return getCameraInfo().K[0] != 0.0; }

bool CameraInfoManager::loadCameraInfo(const std::string& url) {
  std::string name;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    url_ = url;
    name = camera_name_;
    loaded_cam_info_ = true;
  }
  return loadCalibration(url, name);
}

std::string CameraInfoManager::resolveURL(const std::string& url, const std::string& cname) {
  std::string resolved;
  for (std::size_t at = 0; at < url.size();) {
    if (url.compare(at, 7, "${NAME}") == 0) {
      resolved += cname;
      at += 7;
    } else if (url.compare(at, 11, "${ROS_HOME}") == 0) {
      resolved += rosHome();
      at += 11;
    } else {
      if (url.compare(at, 2, "${") == 0)
        ROS_ERROR("[CameraInfoManager] invalid URL substitution (not resolved): %s", url.c_str());
      resolved += url[at++];
    }
  }
  return resolved;
}

CameraInfoManager::url_type_t CameraInfoManager::parseURL(const std::string& resolved_url) {
  if (resolved_url.empty()) return URL_empty;
  if (resolved_url.compare(0, 8, "file:///") == 0) return URL_file;
  if (resolved_url.compare(0, 9, "flash:///") == 0) return URL_flash;
  if (resolved_url.compare(0, 10, "package://") == 0) {
    const std::size_t slash = resolved_url.find('/', 10);
    if (slash > 10 && slash != std::string::npos && slash + 1 < resolved_url.size())
      return URL_package;
  }
  return URL_invalid;
}

bool CameraInfoManager::validateURL(const std::string& url) {
  std::string name;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    name = camera_name_;
  }
  return parseURL(resolveURL(url, name)) < URL_invalid;
}

std::string CameraInfoManager::getPackageFileName(const std::string& url) {
  const std::size_t slash = url.find('/', 10);
  const std::string package = url.substr(10, slash - 10);
  const std::string folder = ros::package::getPath(package);
  if (folder.empty()) {
    ROS_WARN("unknown package: %s (ignored)", package.c_str());
    return "";
  }
  return folder + url.substr(slash);
}

bool CameraInfoManager::loadCalibration(const std::string& url, const std::string& cname) {
  const std::string resolved = resolveURL(url, cname);
  switch (parseURL(resolved)) {
    case URL_empty: {
      ROS_INFO("using default calibration URL");
      return loadCalibration(kDefaultUrl, cname);
    }
    case URL_file:
      ROS_INFO("camera calibration URL: %s", resolved.c_str());
      return loadCalibrationFile(resolved.substr(7), cname);
    case URL_package: {
      ROS_INFO("camera calibration URL: %s", resolved.c_str());
      const std::string file_name = getPackageFileName(resolved);
      return !file_name.empty() && loadCalibrationFile(file_name, cname);
    }
    case URL_flash:
      ROS_WARN("[CameraInfoManager] reading from flash not implemented yet");
      return false;
    case URL_invalid:
      break;
  }
  ROS_ERROR("Invalid camera calibration URL: %s", resolved.c_str());
  return false;
}

bool CameraInfoManager::loadCalibrationFile(const std::string& filename, const std::string& cname) {
  struct stat found;
  if (stat(filename.c_str(), &found) != 0) {
    ROS_WARN("Camera calibration file %s not found.", filename.c_str());
    return false;
  }
  std::string name;
  sensor_msgs::CameraInfo info;
  if (!camera_calibration_parsers::readCalibration(filename, name, info)) {
    ROS_WARN("Camera calibration file %s not found.", filename.c_str());
    return false;
  }
  if (name != cname)
    ROS_WARN("[%s] does not match name %s in file %s", cname.c_str(), name.c_str(),
             filename.c_str());
  const std::lock_guard<std::mutex> lock(mutex_);
  cam_info_ = info;
  return true;
}

bool CameraInfoManager::saveCalibration(const sensor_msgs::CameraInfo& new_info,
                                        const std::string& url, const std::string& cname) {
  const std::string resolved = resolveURL(url, cname);
  switch (parseURL(resolved)) {
    case URL_empty:
      return saveCalibration(new_info, kDefaultUrl, cname);
    case URL_file:
      return saveCalibrationFile(new_info, resolved.substr(7), cname);
    case URL_package: {
      const std::string file_name = getPackageFileName(resolved);
      return !file_name.empty() && saveCalibrationFile(new_info, file_name, cname);
    }
    default:
      ROS_ERROR("invalid url: %s (ignored)", resolved.c_str());
      return saveCalibration(new_info, kDefaultUrl, cname);
  }
}

bool CameraInfoManager::saveCalibrationFile(const sensor_msgs::CameraInfo& new_info,
                                            const std::string& filename, const std::string& cname) {
  ROS_INFO("writing calibration data to %s", filename.c_str());
  if (!makeFolder(filename)) {
    ROS_ERROR("The folder of %s cannot be made", filename.c_str());
    return false;
  }
  return camera_calibration_parsers::writeCalibration(filename, cname, new_info);
}

bool CameraInfoManager::setCameraName(const std::string& cname) {
  if (!isName(cname)) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  camera_name_ = cname;
  loaded_cam_info_ = false;
  return true;
}

bool CameraInfoManager::setCameraInfo(const sensor_msgs::CameraInfo& camera_info) {
  const std::lock_guard<std::mutex> lock(mutex_);
  cam_info_ = camera_info;
  loaded_cam_info_ = true;
  return true;
}

bool CameraInfoManager::onSetCameraInfo(sensor_msgs::SetCameraInfo::Request& request,
                                        sensor_msgs::SetCameraInfo::Response& response) {
  if (!ros::ok()) {
    ROS_ERROR("set_camera_info service called, but driver not running.");
    response.status_message = "Camera driver not running.";
    response.success = false;
    return false;
  }
  std::string name, url;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    cam_info_ = request.camera_info;
    loaded_cam_info_ = true;
    name = camera_name_;
    url = url_;
  }
  response.success = saveCalibration(request.camera_info, url, name);
  if (!response.success) response.status_message = "Error storing camera calibration.";
  return true;
}

}  // namespace camera_info_manager
