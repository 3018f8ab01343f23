// What a master would know, asked of the graph.

#include <ros/console.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <gazelle/core.hpp>

#include <unistd.h>

#include <cstdlib>
#include <map>

#include "node_state.hpp"

namespace ros {

namespace {

const char* uriOf() {
  const char* const variable = std::getenv("ROS_MASTER_URI");
  return variable && *variable ? variable : "http://localhost:11311";
}

gazelle::Json ask(const char* verb, const gazelle::Json& request = gazelle::Json::object()) {
  try {
    return gazelle::call(verb, request);
  } catch (const gazelle::Error& error) {
    ROS_ERROR("The graph does not answer: %s", error.what());
    return gazelle::Json();
  }
}

// The master's getSystemState: [[topic, [publishers]]…], the same of subscribers and of services.
gazelle::Json systemState() {
  gazelle::Json state = gazelle::Json::array();
  for (const char* kind : {"publisher", "subscription", "service"}) {
    std::map<std::string, std::vector<std::string> > nodes;
    const gazelle::Json ends = ask("graph/ends", gazelle::Json::object({{"kind", kind}}));
    for (const gazelle::Json& end : ends.items())
      nodes[end["name"].as_string()].push_back(end["node"].as_string());
    gazelle::Json rows = gazelle::Json::array();
    for (const auto& row : nodes)
      rows.push(gazelle::Json::array({gazelle::Json(row.first), gazelle::Json(row.second)}));
    state.push(rows);
  }
  return state;
}

}  // namespace

namespace master {

const std::string& getURI() {
  static const std::string uri(uriOf());
  return uri;
}

const std::string& getHost() {
  static const std::string found = [] {
    std::string host;
    uint32_t port = 0;
    network::splitURI(getURI(), host, port);
    return host;
  }();
  return found;
}

uint32_t getPort() {
  std::string host;
  uint32_t port = 0;
  network::splitURI(getURI(), host, port);
  return port;
}

bool check() { return gazelle::is_attached(); }

bool getTopics(V_TopicInfo& topics) {
  const gazelle::Json found = ask("graph/topics");
  for (const gazelle::Json& topic : found.items())
    topics.push_back(TopicInfo(topic[0].as_string(), topic[1].as_string()));
  return found.is_array();
}

bool getNodes(V_string& nodes) {
  const gazelle::Json found = ask("graph/nodes");
  for (const std::string& node : found.as_strings()) nodes.push_back(node);
  return found.is_array();
}

void setRetryTimeout(WallDuration) {}

bool execute(const std::string& method, const XmlRpc::XmlRpcValue& request,
             XmlRpc::XmlRpcValue& response, XmlRpc::XmlRpcValue& payload, bool) {
  gazelle::Json found;
  if (method == "getPublishedTopics" || method == "getTopicTypes") {
    found = ask("graph/topics");
  } else if (method == "getSystemState") {
    found = systemState();
  } else if (method == "getUri") {
    found = getURI();
  } else if (method == "getPid") {
    found = static_cast<int>(getpid());
  } else if (method == "getParamNames") {
    found = ask("param/names");
  } else if (method == "hasParam" || method == "getParam" || method == "deleteParam") {
    const std::string key = names::resolve(static_cast<const std::string&>(request[1]));
    const gazelle::Json name = gazelle::Json::object({{"name", key}});
    if (method == "hasParam") {
      found = ask("param/has", name);
    } else if (method == "deleteParam") {
      found = ask("param/delete", name);
    } else {
      const gazelle::Json answer = ask("param/get", name);
      if (!answer["found"].as_bool()) return false;
      found = answer["value"];
    }
  } else if (method == "lookupNode" || method == "lookupService") {
    const std::string wanted = request[1];
    for (const std::string& name :
         ask(method == "lookupNode" ? "graph/nodes" : "graph/services").as_strings())
      if (name == wanted) found = "http://" + network::getHost() + ":0/";
    if (found.is_null()) return false;
  } else {
    ROS_ERROR("ros::master::execute: there is no master, and '%s' is nothing that the graph knows",
              method.c_str());
    return false;
  }
  payload = detail::valueOf(found);
  response[0] = 1;
  response[1] = std::string();
  response[2] = payload;
  return true;
}

}  // namespace master

namespace this_node {

namespace {

// Topics of this node by the system's state: publishers (0) or subscribers (1).
void topicsOf(int side, V_string& topics) {
  topics.clear();
  const gazelle::Json state = systemState();
  for (const gazelle::Json& topic : state[side].items())
    for (const std::string& node : topic[1].as_strings())
      if (node == getName()) topics.push_back(topic[0].as_string());
}

}  // namespace

void getAdvertisedTopics(V_string& topics) { topicsOf(0, topics); }
void getSubscribedTopics(V_string& topics) { topicsOf(1, topics); }

}  // namespace this_node

}  // namespace ros
