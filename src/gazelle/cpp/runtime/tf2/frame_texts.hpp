// What is said about frames: tf2's texts, with whose job the missing transform would be (REP 105).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tf2/LinearMath/Transform.h"

namespace gazelle::frame_texts {

extern const char* const loop;

// What is wrong with a transform that comes in; empty: nothing.
std::string problem(const std::string& frame, const std::string& child,
                    const tf2::Vector3& translation, const tf2::Quaternion& rotation,
                    double norm_tolerance, const std::string& authority);
// What is wrong with a frame's name; empty: nothing.
std::string illegal(const char* argument, const std::string& frame);
std::string unknown(const char* argument, const std::string& frame,
                    const std::vector<std::string>& known);
std::string cannot_ros1(const char* argument, const std::string& frame);
std::string cannot_ros2(const char* argument, const std::string& frame);
std::string outside(std::int64_t asked_ns, std::int64_t oldest_ns, std::int64_t newest_ns,
                    std::size_t count);
std::string unconnected(const std::string& target, const std::string& source,
                        const std::string& target_root, const std::string& source_root);
std::string yaml(const std::string& name, const std::string& parent, const std::string& authority,
                 double rate, double newest_s, double oldest_s, double now_s);
std::string dot_edge(const std::string& name, const std::string& parent,
                     const std::string& authority, double rate, double newest_s, double oldest_s,
                     double now_s);
std::string dot_graph(const std::string& edges, const std::vector<std::string>& roots,
                      double now_s);

}  // namespace gazelle::frame_texts
