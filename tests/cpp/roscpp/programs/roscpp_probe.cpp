// What the tests of roscpp ask of it, a word each.

#include <actionlib/client/simple_action_client.h>
#include <actionlib/server/simple_action_server.h>
#include <actionlib_tutorials/FibonacciAction.h>
#include <message_filters/cache.h>
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/sync_policies/exact_time.h>
#include <message_filters/synchronizer.h>
#include <message_filters/time_synchronizer.h>
#include <ros/package.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>
#include <std_srvs/SetBool.h>
#include <topic_tools/shape_shifter.h>

#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <thread>

namespace {

void say(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}
void say(const std::string& text, double value) {
  std::printf("%s %g\n", text.c_str(), value);
  std::fflush(stdout);
}

// A class of a user's own in place of std_msgs/String.
struct OwnText {
  std::string text;
};

struct Listener {
  void member(const std_msgs::String& message) { say("member " + message.data); }
  void pointer(const std_msgs::StringConstPtr& message) const { say("pointer " + message->data); }
  void mutableOne(const std_msgs::StringPtr& message) {
    message->data += "!";
    say("mutable " + message->data);
  }
  void event(const ros::MessageEvent<std_msgs::String const>& event) {
    say("event " + event.getMessage()->data + " from " + event.getPublisherName() + " " +
        event.getConnectionHeader()["type"]);
  }
};
void function(const std_msgs::String::ConstPtr& message) { say("function " + message->data); }
void withData(const std_msgs::String::ConstPtr& message, const std::string& data) {
  say("bound " + data + " " + message->data);
}

int echo(ros::NodeHandle& node) {
  ros::Publisher out = node.advertise<std_msgs::String>("out", 10);
  Listener listener;
  std::vector<ros::Subscriber> all;
  all.push_back(node.subscribe("in", 10, &Listener::member, &listener));
  all.push_back(node.subscribe("in", 10, &Listener::pointer, &listener));
  all.push_back(node.subscribe("in", 10, &Listener::mutableOne, &listener));
  all.push_back(node.subscribe("in", 10, &Listener::event, &listener));
  all.push_back(node.subscribe("in", 10, function));
  all.push_back(node.subscribe<std_msgs::String>("in", 10, boost::bind(&withData, _1, "data")));
  all.push_back(
      node.subscribe<std_msgs::String>("in", 10, [&](const std_msgs::String::ConstPtr& message) {
        std_msgs::String answer;
        answer.data = "heard " + message->data;
        out.publish(answer);
      }));
  boost::shared_ptr<Listener> tracked = boost::make_shared<Listener>();
  all.push_back(node.subscribe("gone", 10, &Listener::member, tracked));
  tracked.reset();
  say("ready");
  ros::spin();
  say("ended");
  return 0;
}

int parameters(ros::NodeHandle& node) {
  ros::NodeHandle own("~");
  node.setParam("text", "hello");
  node.setParam("number", 2.5);
  node.setParam("list", std::vector<int>{1, 2, 3});
  node.setParam("table", std::map<std::string, std::string>{{"a", "x"}});
  std::string text;
  double number = 0;
  int whole = 0;
  std::vector<double> list;
  std::map<std::string, std::string> table;
  XmlRpc::XmlRpcValue value;
  say(node.getParam("text", text) ? "text " + text : "none");
  node.getParam("number", number);
  say("number", number);
  node.getParam("number", whole);
  say("rounded", whole);
  node.getParam("list", list);
  say("list", list.back());
  say(node.getParam("table", table) ? "table " + table["a"] : "none");
  say(node.getParam("text", number) ? "taken" : "text is no number");
  own.getParam("private", whole);
  say("private", whole);
  say("default", node.param("missing", 7));
  node.getParam("python", value);
  say("python", static_cast<double>(value["deep"][1]["value"]));
  std::string found;
  say(own.searchParam("text", found) ? "found " + found : "none");
  say(node.deleteParam("text") && !node.hasParam("text") ? "deleted" : "still there");
  XmlRpc::XmlRpcValue made;
  made[0] = 1;
  made[1]["name"] = "two";
  node.setParam("made", made);
  try {
    say(static_cast<std::string&>(made[0]));
  } catch (const XmlRpc::XmlRpcException& error) {
    say("wrong type told");
  }
  return 0;
}

int names(ros::NodeHandle& node) {
  say("node " + ros::this_node::getName() + " in " + ros::this_node::getNamespace());
  say("remapped " + node.resolveName("chatter"));
  say("private " + ros::names::resolve("~x"));
  ros::NodeHandle below(node, "below");
  say("below " + below.resolveName("y"));
  try {
    node.subscribe("bad name", 1, function);
  } catch (const ros::InvalidNameException& error) {
    say("bad name told");
  }
  say("package " + std::to_string(!ros::package::getPath("std_msgs").empty()));
  return 0;
}

int services(ros::NodeHandle& node) {
  ros::ServiceServer server =
      node.advertiseService<std_srvs::SetBool::Request, std_srvs::SetBool::Response>(
          "switch", [&](std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
            response.success = true;
            response.message = request.data ? "on" : "off";
            return request.data != 0;
          });
  ros::AsyncSpinner spinner(1);
  spinner.start();
  std_srvs::SetBool own;
  own.request.data = true;
  say(ros::service::call("switch", own) ? "own " + own.response.message : "own failed");
  own.request.data = false;
  say(ros::service::call("switch", own) ? "own again" : "refused");
  say(ros::service::waitForService("nobody", 50) ? "somebody" : "nobody");
  ros::ServiceClient client = node.serviceClient<std_srvs::SetBool>("python");
  client.waitForExistence();
  own.request.data = true;
  say(client.call(own) ? "python " + own.response.message : "python failed");
  say("ready");
  ros::waitForShutdown();
  return 0;
}

int timers(ros::NodeHandle& node) {
  int count = 0;
  ros::Timer timer =
      node.createTimer(ros::Duration(1.0), ros::TimerCallback([&](const ros::TimerEvent& event) {
                         say("tick", event.current_real.toSec());
                         ++count;
                       }));
  ros::Timer once =
      node.createTimer(ros::Duration(1.5), ros::TimerCallback([&](const ros::TimerEvent& event) {
                         say("once", event.current_expected.toSec());
                       }),
                       true);
  ros::WallTimer wall = node.createWallTimer(
      ros::WallDuration(0.01), ros::WallTimerCallback([&](const ros::WallTimerEvent&) {
        say("wall");
        wall.stop();
      }));
  ros::SteadyTimer steady = node.createSteadyTimer(
      ros::WallDuration(0.01),
      ros::SteadyTimerCallback([&](const ros::SteadyTimerEvent&) { say("steady"); }), true);
  say("ready", ros::Time::isSimTime());
  while (ros::ok() && count < 3)
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  return 0;
}

int queues(ros::NodeHandle& node) {
  ros::CallbackQueue queue;
  ros::NodeHandle other;
  other.setCallbackQueue(&queue);
  int here = 0, there = 0;
  ros::Subscriber a = node.subscribe<std_msgs::Int32>(
      "n", 2, [&](const std_msgs::Int32::ConstPtr& message) { here = message->data; });
  ros::Subscriber b = other.subscribe<std_msgs::Int32>(
      "n", 100, [&](const std_msgs::Int32::ConstPtr&) { ++there; });
  ros::Publisher publisher = node.advertise<std_msgs::Int32>("n", 100);
  for (int i = 1; i <= 50; ++i) {
    std_msgs::Int32 message;
    message.data = i;
    publisher.publish(message);
  }
  say("waiting", !queue.isEmpty());
  ros::spinOnce();
  say("last", here);
  queue.callOne(ros::WallDuration(1.0));
  say("one", there);
  queue.callAvailable();
  say("all", there);
  b.shutdown();
  const std_msgs::Int32::Ptr shared = boost::make_shared<std_msgs::Int32>();
  const std_msgs::Int32* seen = nullptr;
  ros::Subscriber c = node.subscribe<std_msgs::Int32>(
      "n", 2, [&](const std_msgs::Int32::ConstPtr& message) { seen = message.get(); });
  publisher.publish(shared);
  ros::spinOnce();
  say("same object", seen == shared.get());
  say("subscribers", publisher.getNumSubscribers());
  return 0;
}

int latched(ros::NodeHandle& node) {
  ros::Publisher publisher = node.advertise<std_msgs::String>(
      "map", 1,
      [](const ros::SingleSubscriberPublisher& one) {
        say("connected " + one.getSubscriberName());
      },
      [](const ros::SingleSubscriberPublisher& one) { say("left " + one.getSubscriberName()); },
      ros::VoidConstPtr(), true);
  std_msgs::String message;
  message.data = "the map";
  publisher.publish(message);
  const std_msgs::String::ConstPtr got = ros::topic::waitForMessage<std_msgs::String>("map");
  say("got " + (got ? got->data : "nothing"));
  say("ready");
  ros::spin();
  return 0;
}

int logs(ros::NodeHandle& node) {
  static_cast<void>(node);
  ROS_DEBUG("not heard");
  ROS_INFO("info %d", 1);
  ROS_WARN_STREAM("warn " << 2);
  ROS_ERROR_NAMED("part", "error");
  for (int i = 0; i < 3; ++i) {
    ROS_INFO_ONCE("once");
    ROS_INFO_THROTTLE(100, "throttled");
    ROS_INFO_COND(i == 1, "condition %d", i);
  }
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Debug);
  ROS_DEBUG("heard");
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Info);
  say("ready");
  while (ros::ok()) {
    ROS_DEBUG_NAMED("quiet", "by service");
    ros::WallDuration(0.02).sleep();
  }
  return 0;
}

int anyType(ros::NodeHandle& node) {
  ros::Publisher copy;
  ros::Subscriber any = node.subscribe<topic_tools::ShapeShifter>(
      "in", 10, [&](const topic_tools::ShapeShifter::ConstPtr& message) {
        say(message->getDataType() + " " + message->getMD5Sum());
        if (!copy) copy = message->advertise(node, "copy", 10, true);
        copy.publish(*message);
      });
  ros::Subscriber own = node.subscribe<OwnText>(
      "own", 10,
      [&](const boost::shared_ptr<OwnText const>& message) { say("own " + message->text); });
  ros::Publisher publisher = node.advertise<OwnText>("own_out", 10, true);
  OwnText text;
  text.text = "made by hand";
  publisher.publish(text);
  say("ready");
  ros::spin();
  return 0;
}

int filters(ros::NodeHandle& node) {
  typedef sensor_msgs::Image Image;
  static_cast<void>(node);
  const auto image = [](double stamp) {
    const boost::shared_ptr<Image> made = boost::make_shared<Image>();
    made->header.stamp = ros::Time(stamp);
    return made;
  };
  message_filters::TimeSynchronizer<Image, Image> exact(10);
  exact.registerCallback(
      [](const sensor_msgs::ImageConstPtr& a, const sensor_msgs::ImageConstPtr&) {
        say("exact", a->header.stamp.toSec());
      });
  exact.add0(image(1));
  exact.add1(image(2));
  exact.add0(image(2));
  exact.add0(image(3));
  exact.add1(image(3));

  typedef message_filters::sync_policies::ApproximateTime<Image, Image> Policy;
  message_filters::Synchronizer<Policy> near((Policy(10)));
  near.registerCallback(
      [](const sensor_msgs::ImageConstPtr& a, const sensor_msgs::ImageConstPtr& b) {
        say("near " + std::to_string(a->header.stamp.toSec()), b->header.stamp.toSec());
      });
  for (int i = 1; i < 6; ++i) {
    near.add<0>(image(i));
    near.add<1>(image(i + 0.1));
  }
  message_filters::Cache<Image> cache(3);
  for (int i = 1; i < 6; ++i) cache.add(image(i));
  say("cache", cache.getInterval(ros::Time(0.5), ros::Time(4.5)).size());
  say("before", cache.getElemBeforeTime(ros::Time(4.5))->header.stamp.toSec());
  return 0;
}

int bags(ros::NodeHandle& node, const std::string& file) {
  static_cast<void>(node);
  rosbag::View::Query all = [](rosbag::ConnectionInfo const*) { return true; };
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  rosbag::View view(bag, all);
  rosbag::Bag copy;
  copy.setCompression(rosbag::compression::BZ2);
  copy.open(file + ".copy", rosbag::bagmode::Write);
  for (const rosbag::MessageInstance& message : view) {
    const std_msgs::String::ConstPtr text = message.instantiate<std_msgs::String>();
    say(message.getTopic() + " " + (text ? text->data : message.getDataType()),
        message.getTime().toSec());
    copy.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
  }
  copy.close();
  try {
    rosbag::Bag none("/nowhere.bag");
  } catch (const rosbag::BagIOException& error) {
    say("missing told");
  }
  return 0;
}

typedef actionlib::SimpleActionServer<actionlib_tutorials::FibonacciAction> Server;
typedef actionlib::SimpleActionClient<actionlib_tutorials::FibonacciAction> Client;

int actionServer(ros::NodeHandle& node) {
  Server* running = nullptr;
  Server server(
      node, "fibonacci",
      [&](const actionlib_tutorials::FibonacciGoalConstPtr& goal) {
        actionlib_tutorials::FibonacciFeedback feedback;
        feedback.sequence = {0, 1};
        running->publishFeedback(feedback);
        while (goal->order > 100 && ros::ok() && !running->isPreemptRequested())
          ros::WallDuration(0.01).sleep();
        actionlib_tutorials::FibonacciResult result;
        result.sequence = {0, 1, goal->order};
        if (running->isPreemptRequested())
          running->setPreempted(result, "asked to end");
        else
          running->setSucceeded(result, "done");
      },
      false);
  running = &server;
  server.start();
  say("ready");
  ros::spin();
  return 0;
}

int actionClient(ros::NodeHandle& node) {
  Client client(node, "fibonacci", true);
  client.waitForServer();
  actionlib_tutorials::FibonacciGoal goal;
  goal.order = 5;
  bool is_active = false;
  int feedbacks = 0;
  client.sendGoal(
      goal,
      [](const actionlib::SimpleClientGoalState& state,
         const actionlib_tutorials::FibonacciResultConstPtr& result) {
        say("done " + state.toString() + " " + state.getText(), result->sequence.back());
      },
      [&] { is_active = true; },
      [&](const actionlib_tutorials::FibonacciFeedbackConstPtr&) { ++feedbacks; });
  say("result", client.waitForResult());
  say("active", is_active);
  say("feedback", feedbacks > 0);
  say("state " + client.getState().toString());
  goal.order = 1000;
  client.sendGoal(goal);
  while (ros::ok() && client.getState() != actionlib::SimpleClientGoalState::ACTIVE)
    ros::WallDuration(0.01).sleep();
  client.cancelGoal();
  client.waitForResult();
  say("state " + client.getState().toString());
  return 0;
}

int throughput(ros::NodeHandle& node) {
  int got = 0;
  ros::Subscriber subscriber =
      node.subscribe<std_msgs::Int32>("n", 0, [&](const std_msgs::Int32::ConstPtr&) { ++got; });
  ros::Publisher publisher = node.advertise<std_msgs::Int32>("n", 1000);
  const ros::SteadyTime begin = ros::SteadyTime::now();
  std_msgs::Int32 message;
  for (int i = 0; i < 200000; ++i) {
    message.data = i;
    publisher.publish(message);
    if (i % 100 == 99) ros::spinOnce();
  }
  say("a second", got / (ros::SteadyTime::now() - begin).toSec());
  return 0;
}

}  // namespace

namespace ros {
namespace message_traits {
template <>
struct DataType<OwnText> {
  static const char* value() { return "std_msgs/String"; }
  static const char* value(const OwnText&) { return value(); }
};
template <>
struct MD5Sum<OwnText> {
  static const char* value() { return "992ce8a1687cec8c8bd883ec73ca41d1"; }
  static const char* value(const OwnText&) { return value(); }
};
template <>
struct Definition<OwnText> {
  static const char* value() { return "string data\n"; }
  static const char* value(const OwnText&) { return value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<OwnText> {
  template <typename Stream, typename T>
  inline static void allInOne(Stream& stream, T text) {
    stream.next(text.text);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};
}  // namespace serialization
}  // namespace ros

int main(int argc, char** argv) {
  ros::init(argc, argv, "probe");
  ros::NodeHandle node;
  const std::string word = argc > 1 ? argv[1] : "";
  const std::map<std::string, std::function<int(ros::NodeHandle&)> > words{
      {"echo", echo},
      {"parameters", parameters},
      {"names", names},
      {"services", services},
      {"timers", timers},
      {"queues", queues},
      {"latched", latched},
      {"logs", logs},
      {"any", anyType},
      {"filters", filters},
      {"action_server", actionServer},
      {"action_client", actionClient},
      {"throughput", throughput},
      {"bags", [&](ros::NodeHandle& handle) { return bags(handle, argv[2]); }}};
  return words.at(word)(node);
}
