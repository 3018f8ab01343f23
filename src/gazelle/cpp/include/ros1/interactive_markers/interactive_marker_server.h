#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>

#include <boost/function.hpp>
#include <boost/noncopyable.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "interactive_markers/tools.h"

namespace interactive_markers {

using FeedbackCallback =
    boost::function<void(const visualization_msgs::InteractiveMarkerFeedbackConstPtr&)>;
using FeedbackConstPtr = visualization_msgs::InteractiveMarkerFeedbackConstPtr;
using HeaderMsg = std_msgs::Header;
using InteractiveMarkerFeedback = visualization_msgs::InteractiveMarkerFeedback;
using InteractiveMarkerPose = visualization_msgs::InteractiveMarkerPose;
using InteractiveMarkerUpdate = visualization_msgs::InteractiveMarkerUpdate;
using MenuEntry = visualization_msgs::MenuEntry;
using PoseMsg = geometry_msgs::Pose;
inline bool has_stamp(const HeaderMsg& header) { return !header.stamp.isZero(); }

#include "gazelle/interactive_markers/server_core.inc"

// Offers markers that people move and press; changes are seen after applyChanges().
class InteractiveMarkerServer : boost::noncopyable {
 public:
  typedef visualization_msgs::InteractiveMarkerFeedbackConstPtr FeedbackConstPtr;
  typedef interactive_markers::FeedbackCallback FeedbackCallback;
  static const std::uint8_t DEFAULT_FEEDBACK_CB = 255;

  InteractiveMarkerServer(const std::string& topic_ns, const std::string& server_id = "",
                          bool spin_thread = false)
      : node_handle_(topic_ns) {
    if (spin_thread) node_handle_.setCallbackQueue(&queue_);
    server_id_ = ros::this_node::getName() + (server_id.empty() ? "" : "/" + server_id);
    init_ =
        node_handle_.advertise<visualization_msgs::InteractiveMarkerInit>("update_full", 100, true);
    update_ = node_handle_.advertise<visualization_msgs::InteractiveMarkerUpdate>("update", 100);
    feedback_ = node_handle_.subscribe("feedback", 100, &InteractiveMarkerServer::take, this);
    keep_alive_ = node_handle_.createTimer(ros::Duration(0.5),
                                           [this](const ros::TimerEvent&) { keep_alive(); });
    publish_init();
    if (spin_thread) {
      spinner_.reset(new ros::AsyncSpinner(1, &queue_));
      spinner_->start();
    }
  }
  ~InteractiveMarkerServer() {
    if (spinner_) spinner_->stop();
    if (!node_handle_.ok()) return;
    clear();
    applyChanges();
  }

  void insert(const InteractiveMarker& int_marker) { core_.insert(int_marker); }
  void insert(const InteractiveMarker& int_marker, FeedbackCallback feedback_cb,
              std::uint8_t feedback_type = DEFAULT_FEEDBACK_CB) {
    insert(int_marker);
    setCallback(int_marker.name, feedback_cb, feedback_type);
  }
  bool setPose(const std::string& name, const geometry_msgs::Pose& pose,
               const std_msgs::Header& header = std_msgs::Header()) {
    return core_.set_pose_of(name, pose, header);
  }
  bool erase(const std::string& name) { return core_.erase(name); }
  void clear() { core_.clear(); }
  bool empty() const { return size() == 0; }
  std::size_t size() const { return core_.size(); }
  // An empty callback takes the one away that is there.
  bool setCallback(const std::string& name, FeedbackCallback feedback_cb,
                   std::uint8_t feedback_type = DEFAULT_FEEDBACK_CB) {
    return core_.set_callback(name, feedback_cb, feedback_type);
  }
  void applyChanges() {
    const std::lock_guard<std::recursive_mutex> lock(core_.mutex);
    visualization_msgs::InteractiveMarkerUpdate update;
    if (!core_.apply(update)) return;
    update.type = visualization_msgs::InteractiveMarkerUpdate::UPDATE;
    publish(update);
    publish_init();
  }
  bool get(std::string name, InteractiveMarker& int_marker) const {
    return core_.get(name, int_marker);
  }

 private:
  void take(const FeedbackConstPtr& message) { core_.feedback(message, ros::Time::now().toSec()); }
  void keep_alive() {
    visualization_msgs::InteractiveMarkerUpdate update;
    update.type = visualization_msgs::InteractiveMarkerUpdate::KEEP_ALIVE;
    publish(update);
  }
  void publish(visualization_msgs::InteractiveMarkerUpdate& update) {
    update.server_id = server_id_;
    update.seq_num = core_.sequence;
    update_.publish(update);
  }
  void publish_init() {
    visualization_msgs::InteractiveMarkerInit init;
    init.server_id = server_id_;
    init.seq_num = core_.sequence;
    core_.all(init.markers);
    init_.publish(init);
  }

  mutable detail::ServerCore core_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_handle_;
  std::string server_id_;
  ros::Publisher init_, update_;
  ros::Subscriber feedback_;
  ros::Timer keep_alive_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace interactive_markers
