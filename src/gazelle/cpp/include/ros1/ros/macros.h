#pragma once
// Attributes that headers of ROS 1 packages write; everything of ours is exported.

#define ROS_DEPRECATED __attribute__((deprecated))
#define ROS_FORCE_INLINE __attribute__((always_inline))
#define ROS_HELPER_IMPORT __attribute__((visibility("default")))
#define ROS_HELPER_EXPORT __attribute__((visibility("default")))
#define ROS_HELPER_LOCAL __attribute__((visibility("hidden")))

#ifdef __GNUC__
#define ROS_UNUSED __attribute__((unused))
#else
#define ROS_UNUSED
#endif

#define ROSCPP_DECL ROS_HELPER_EXPORT
#define ROSTIME_DECL ROS_HELPER_EXPORT
#define ROSCONSOLE_DECL ROS_HELPER_EXPORT
#define ROSLIB_DECL ROS_HELPER_EXPORT
#define XMLRPCPP_DECL ROS_HELPER_EXPORT
