#pragma once

#include <string>
#include <vector>

namespace pluginlib {

// What can be asked of a loader whatever it makes.
class ClassLoaderBase {
 public:
  ClassLoaderBase() = default;
  virtual ~ClassLoaderBase() = default;

  virtual std::vector<std::string> getPluginXmlPaths() = 0;
  virtual std::vector<std::string> getDeclaredClasses() = 0;
  virtual std::string getName(const std::string& lookup_name) = 0;
  virtual bool isClassAvailable(const std::string& lookup_name) = 0;
  virtual std::string getClassType(const std::string& lookup_name) = 0;
  virtual std::string getClassDescription(const std::string& lookup_name) = 0;
  virtual std::string getClassPackage(const std::string& lookup_name) = 0;
  virtual std::string getPluginManifestPath(const std::string& lookup_name) = 0;
  virtual bool isClassLoaded(const std::string& lookup_name) = 0;
  virtual void loadLibraryForClass(const std::string& lookup_name) = 0;
  virtual int unloadLibraryForClass(const std::string& lookup_name) = 0;
};

}  // namespace pluginlib
