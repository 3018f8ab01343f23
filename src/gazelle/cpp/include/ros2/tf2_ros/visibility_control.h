#pragma once
#define TF2_ROS_PUBLIC __attribute__((visibility("default")))
#define TF2_ROS_LOCAL
#define TF2_ROS_PUBLIC_TYPE
#define TF2_ROS_EXPORT
#define TF2_ROS_IMPORT
