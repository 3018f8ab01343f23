// A buffer for other nodes: answers the goals of BufferClient.
#pragma once

#include <boost/bind/bind.hpp>
#include <list>
#include <mutex>
#include <string>

#include "actionlib/server/action_server.h"
#include "ros/ros.h"
#include "tf2_msgs/LookupTransformAction.h"
#include "tf2_msgs/TF2Error.h"
#include "tf2_ros/buffer.h"

namespace tf2_ros {

class BufferServer {
 public:
  BufferServer(const Buffer& buffer, const std::string& ns, bool auto_start = true,
               ros::Duration check_period = ros::Duration(0.01))
      : buffer_(buffer),
        server_(ros::NodeHandle(), ns,
                boost::bind(&BufferServer::asked, this, boost::placeholders::_1),
                boost::bind(&BufferServer::cancelled, this, boost::placeholders::_1), auto_start) {
    ros::NodeHandle node;
    timer_ = node.createTimer(check_period, &BufferServer::look, this);
  }
  void start() { server_.start(); }

 private:
  typedef actionlib::ActionServer<tf2_msgs::LookupTransformAction> Server;
  typedef Server::GoalHandle GoalHandle;
  struct Asked {
    GoalHandle handle;
    ros::Time end;
  };

  void asked(GoalHandle goal) {
    goal.setAccepted("The buffer server has accepted the goal");
    std::lock_guard<std::mutex> hold(lock_);
    goals_.push_back({goal, ros::Time::now() + goal.getGoal()->timeout});
  }
  void cancelled(GoalHandle goal) {
    std::lock_guard<std::mutex> hold(lock_);
    goals_.remove_if([&](Asked& one) {
      if (!(one.handle == goal)) return false;
      one.handle.setCanceled();
      return true;
    });
  }
  void look(const ros::TimerEvent&) {
    std::lock_guard<std::mutex> hold(lock_);
    goals_.remove_if([this](Asked& one) {
      if (!can(one.handle) && ros::Time::now() < one.end) return false;
      answer(one.handle);
      return true;
    });
  }
  bool can(GoalHandle& goal) const {
    const auto asked = goal.getGoal();
    if (!asked->advanced)
      return buffer_.canTransform(asked->target_frame, asked->source_frame, asked->source_time);
    return buffer_.canTransform(asked->target_frame, asked->target_time, asked->source_frame,
                                asked->source_time, asked->fixed_frame);
  }
  void answer(GoalHandle& goal) const {
    using Error = tf2_msgs::TF2Error;
    tf2_msgs::LookupTransformResult result;
    const auto asked = goal.getGoal();
    const auto failed = [&](int code, const std::exception& error) {
      result.error.error = static_cast<uint8_t>(code);
      result.error.error_string = error.what();
    };
    try {
      result.transform =
          asked->advanced
              ? buffer_.lookupTransform(asked->target_frame, asked->target_time,
                                        asked->source_frame, asked->source_time, asked->fixed_frame)
              : buffer_.lookupTransform(asked->target_frame, asked->source_frame,
                                        asked->source_time);
    } catch (const tf2::ConnectivityException& error) {
      failed(Error::CONNECTIVITY_ERROR, error);
    } catch (const tf2::LookupException& error) {
      failed(Error::LOOKUP_ERROR, error);
    } catch (const tf2::ExtrapolationException& error) {
      failed(Error::EXTRAPOLATION_ERROR, error);
    } catch (const tf2::InvalidArgumentException& error) {
      failed(Error::INVALID_ARGUMENT_ERROR, error);
    } catch (const tf2::TransformException& error) {
      failed(Error::TRANSFORM_ERROR, error);
    }
    goal.setSucceeded(result);
  }

  const Buffer& buffer_;
  Server server_;
  std::mutex lock_;
  std::list<Asked> goals_;
  ros::Timer timer_;
};

}  // namespace tf2_ros
