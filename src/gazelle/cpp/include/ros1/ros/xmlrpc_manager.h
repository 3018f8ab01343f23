#pragma once
// There is no XML-RPC between nodes of Gazelle; what users bind here is what happens when somebody
// asks the node to end ("shutdown").

#include <ros/common.h>
#include <ros/forwards.h>

#include <boost/function.hpp>
#include <map>

#include "xmlrpcpp/XmlRpc.h"

namespace ros {

namespace xmlrpc {
ROSCPP_DECL XmlRpc::XmlRpcValue responseStr(int code, const std::string& message,
                                            const std::string& response);
ROSCPP_DECL XmlRpc::XmlRpcValue responseInt(int code, const std::string& message, int response);
}  // namespace xmlrpc

class XMLRPCManager;
typedef boost::shared_ptr<XMLRPCManager> XMLRPCManagerPtr;
typedef boost::function<void(XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue&)> XMLRPCFunc;

class ROSCPP_DECL XMLRPCManager {
 public:
  static const XMLRPCManagerPtr& instance();
  bool bind(const std::string& function_name, const XMLRPCFunc& callback);
  void unbind(const std::string& function_name);
  /// Gazelle's: calls what is bound, or asks for the end where nothing is.
  void hear(const std::string& function_name, const std::string& reason);

 private:
  std::map<std::string, XMLRPCFunc> functions_;
};

}  // namespace ros
