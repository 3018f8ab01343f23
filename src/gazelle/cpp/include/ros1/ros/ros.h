#pragma once
// What a program of ROS 1 includes.

#include <ros/assert.h>
#include <ros/callback_queue.h>
#include <ros/common.h>
#include <ros/console.h>
#include <ros/duration.h>
#include <ros/exception.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/node_handle.h>
#include <ros/param.h>
#include <ros/publisher.h>
#include <ros/rate.h>
#include <ros/service.h>
#include <ros/service_client.h>
#include <ros/service_server.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>
#include <ros/this_node.h>
#include <ros/time.h>
#include <ros/timer.h>
#include <ros/topic.h>
#include <ros/types.h>
#include <ros/wall_timer.h>
