// rosrun nodelet nodelet: a manager, one nodelet alone, or one for somebody else's manager.

#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace {

const char kUsage[] =
    "usage: nodelet load pkg/Type manager - Launch a nodelet of type pkg/Type on manager manager\n"
    "       nodelet standalone pkg/Type   - Launch a nodelet of type pkg/Type in a standalone "
    "node\n"
    "       nodelet unload name manager   - Unload a nodelet by name from manager\n"
    "       nodelet manager               - Launch a nodelet manager node\n";

struct Words {
  std::string command, type, manager;
  std::vector<std::string> rest;
};

bool parse(int argc, char** argv, Words& words) {
  std::vector<std::string> all(argv + 1, argv + argc);
  std::vector<std::string> plain;
  for (const std::string& word : all)
    if (word != "--no-bond") plain.push_back(word);
  if (plain.empty()) return false;
  words.command = plain[0];
  std::size_t used = 1;
  if (words.command == "load" || words.command == "unload") {
    if (plain.size() < 3) return false;
    words.type = plain[1];
    words.manager = plain[2];
    used = 3;
  } else if (words.command == "standalone") {
    if (plain.size() < 2) return false;
    words.type = plain[1];
    used = 2;
  } else if (words.command != "manager") {
    return false;
  }
  words.rest.assign(plain.begin() + static_cast<std::ptrdiff_t>(used), plain.end());
  return true;
}

volatile std::sig_atomic_t is_asked_to_end = 0;
void askToEnd(int) { is_asked_to_end = 1; }

bool unload(const std::string& name, const std::string& manager) {
  ros::NodeHandle node;
  nodelet::NodeletUnload service;
  service.request.name = name;
  return node.serviceClient<nodelet::NodeletUnload>(manager + "/unload_nodelet").call(service);
}

int load(const Words& words) {
  ros::NodeHandle node;
  const std::string name = ros::this_node::getName();
  const std::string manager = ros::names::resolve(words.manager);
  nodelet::NodeletLoad service;
  service.request.name = name;
  service.request.type = words.type;
  for (const auto& pair : ros::names::getRemappings()) {
    service.request.remap_source_args.push_back(pair.first);
    service.request.remap_target_args.push_back(pair.second);
  }
  service.request.my_argv = words.rest;
  ros::ServiceClient client = node.serviceClient<nodelet::NodeletLoad>(manager + "/load_nodelet");
  client.waitForExistence();
  if (!ros::ok()) return 0;
  ROS_INFO("Loading nodelet %s of type %s to manager %s with the following remappings:",
           name.c_str(), words.type.c_str(), words.manager.c_str());
  for (const auto& pair : ros::names::getRemappings())
    ROS_INFO("%s -> %s", pair.first.c_str(), pair.second.c_str());
  if (!client.call(service)) {
    if (ros::ok())
      ROS_FATAL("Failed to load nodelet '%s` of type `%s` to manager `%s'", name.c_str(),
                words.type.c_str(), words.manager.c_str());
    return 1;
  }
  // The nodelet lives as long as this process: it is taken out before the node leaves the graph.
  while (ros::ok() && !is_asked_to_end) {
    ros::WallDuration(0.1).sleep();
    if (!client.exists()) return is_asked_to_end ? 0 : 1;  // the manager is gone
  }
  if (ros::ok() && client.exists()) unload(name, manager);
  return 0;
}

int run(int argc, char** argv) {
  // Names first: what is left of the words is the program's.
  std::vector<char*> kept(argv, argv + argc);
  kept.push_back(nullptr);
  int count = argc;
  ros::V_string plain;
  ros::removeROSArgs(argc, argv, plain);
  std::vector<char*> words_of;
  for (std::string& word : plain) words_of.push_back(&word[0]);
  Words words;
  if (!parse(static_cast<int>(words_of.size()), words_of.data(), words)) {
    std::fputs(kUsage, stderr);
    return -1;
  }
  const bool is_asking = words.command == "load" || words.command == "unload";
  std::string name = words.command == "manager" ? "manager" : words.type;
  for (char& c : name)
    if (c == '/' || c == ':' || c == '.') c = '_';
  uint32_t options = words.command == "manager" ? 0u : 0u + ros::init_options::AnonymousName;
  if (is_asking) options |= ros::init_options::NoSigintHandler;
  ros::init(count, kept.data(), name, options);
  if (is_asking) {
    std::signal(SIGINT, &askToEnd);
    std::signal(SIGTERM, &askToEnd);
  }
  if (words.command == "unload") return unload(words.type, words.manager) ? 0 : 1;
  if (is_asking) return load(words);

  ros::NodeHandle node;
  nodelet::Loader loader(words.command == "manager");
  if (words.command == "standalone") {
    const std::string own = ros::this_node::getName();
    if (!loader.load(own, words.type, ros::names::getRemappings(), words.rest)) return 1;
    ROS_DEBUG("Successfully loaded nodelet of type '%s' into name '%s'", own.c_str(), own.c_str());
  }
  ros::spin();
  return 0;
}

}  // namespace

// What the host runs; a library of ours has no `main`.
extern "C" __attribute__((visibility("default"))) int (*gazelle_node_main)(int, char**) = &run;
