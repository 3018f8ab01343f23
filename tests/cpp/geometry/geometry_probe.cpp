// What the tests call by ctypes: the tree of frames, tf2's linear algebra, KDL, laser scans.
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "angles/angles.h"
#include "gazelle/frame_tree.hpp"
#include "gazelle/laser_projection.hpp"
#include "kdl/kdl.hpp"
#include "tf2/LinearMath/Transform.h"

namespace {

using Sink = void (*)(const char* text);

struct Tree {
  explicit Tree(std::int64_t cache_ns) : tree(cache_ns) {
    tree.on_warning([this](const std::string& text) { warnings += text + "\n"; });
  }
  gazelle::FrameTree tree;
  std::string warnings;
  std::string answers;
};

int put(const gazelle::FoundTransform& found, std::int64_t* stamp, double* out) {
  *stamp = found.stamp_ns;
  for (int i = 0; i < 3; ++i) out[i] = found.translation[i];
  for (int i = 0; i < 4; ++i) out[3 + i] = found.rotation[i];
  return 0;
}

template <class Function>
int guarded(Sink sink, Function function) {
  try {
    return function();
  } catch (const tf2::LookupException& error) {
    sink(error.what());
    return 1;
  } catch (const tf2::ConnectivityException& error) {
    sink(error.what());
    return 2;
  } catch (const tf2::ExtrapolationException& error) {
    sink(error.what());
    return 3;
  } catch (const tf2::InvalidArgumentException& error) {
    sink(error.what());
    return 4;
  }
}

tf2::Quaternion quaternion(const double* q) { return tf2::Quaternion(q[0], q[1], q[2], q[3]); }

// An arm of six joints about several axes, with masses.
KDL::Chain arm() {
  KDL::Chain chain;
  const KDL::Vector axes[] = {{0, 0, 1}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  const KDL::Vector tips[] = {{0, 0, 0.3},    {0.05, 0, 0.4}, {0.3, 0, 0.02},
                              {0.1, 0.02, 0}, {0.08, 0, 0},   {0.06, 0, 0.01}};
  for (int i = 0; i < 6; ++i) {
    const KDL::RigidBodyInertia inertia(1.5 - 0.2 * i, tips[i] * 0.5,
                                        KDL::RotationalInertia(0.02, 0.03, 0.025));
    chain.addSegment(KDL::Segment("link" + std::to_string(i),
                                  KDL::Joint("joint" + std::to_string(i), KDL::Vector(0.01, 0, 0),
                                             axes[i], KDL::Joint::RotAxis),
                                  KDL::Frame(KDL::Rotation::RPY(0.1 * i, 0.0, 0.05), tips[i]),
                                  inertia));
  }
  return chain;
}

KDL::JntArray joints(const double* values) {
  KDL::JntArray out(6);
  for (unsigned i = 0; i < 6; ++i) out(i) = values[i];
  return out;
}

void put(const KDL::JntArray& array, double* out) {
  for (unsigned i = 0; i < array.rows(); ++i) out[i] = array(i);
}

void put(const KDL::Frame& frame, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = frame.p(i);
  frame.M.GetQuaternion(out[3], out[4], out[5], out[6]);
}

struct Scan {
  std::string header;
  float angle_min, angle_increment, time_increment, range_min, range_max;
  std::vector<float> ranges, intensities;
};

struct Field {
  std::string name;
  std::uint32_t offset, count;
  std::uint8_t datatype;
};

struct Cloud {
  std::string header;
  std::uint32_t height, width, point_step, row_step;
  std::vector<Field> fields;
  std::vector<std::uint8_t> data;
  bool is_bigendian, is_dense;
};

}  // namespace

extern "C" {

Tree* tree_new(std::int64_t cache_ns) { return new Tree(cache_ns); }
void tree_delete(Tree* tree) { delete tree; }
void tree_clear(Tree* tree) { tree->tree.clear(); }
int tree_set(Tree* tree, const char* parent, const char* child, std::int64_t stamp,
             const double* pose, const char* authority, int is_static) {
  return tree->tree.set(parent, child, stamp, tf2::Vector3(pose[0], pose[1], pose[2]),
                        quaternion(pose + 3), authority, is_static != 0);
}
int tree_look_up(Tree* tree, const char* target, const char* source, std::int64_t stamp,
                 std::int64_t* found, double* pose, Sink sink) {
  return guarded(sink, [&] { return put(tree->tree.look_up(target, source, stamp), found, pose); });
}
int tree_look_up_between(Tree* tree, const char* target, std::int64_t target_stamp,
                         const char* source, std::int64_t source_stamp, const char* fixed,
                         std::int64_t* found, double* pose, Sink sink) {
  return guarded(sink, [&] {
    return put(tree->tree.look_up(target, target_stamp, source, source_stamp, fixed), found, pose);
  });
}
int tree_can(Tree* tree, const char* target, const char* source, std::int64_t stamp, Sink sink) {
  std::string why;
  const bool is_there = tree->tree.can(target, source, stamp, &why);
  sink(why.c_str());
  return is_there;
}
std::uint64_t tree_request(Tree* tree, const char* target, const char* source, std::int64_t stamp) {
  return tree->tree.request(target, source, stamp, [tree](std::uint64_t number, bool is_there) {
    tree->answers += std::to_string(number) + (is_there ? "+" : "-");
  });
}
void tree_text(Tree* tree, int what, Sink sink) {
  std::string text;
  if (what == 0) text = tree->tree.as_text();
  if (what == 1) text = tree->tree.as_yaml(0.0);
  if (what == 2) text = tree->tree.as_dot(0.0);
  if (what == 3) text = tree->warnings;
  if (what == 4) text = tree->answers;
  sink(text.c_str());
}
int tree_chain(Tree* tree, const char* target, const char* source, Sink sink) {
  return guarded(sink, [&] {
    std::string all;
    for (const std::string& one : tree->tree.chain(target, 0, source, 0, target)) all += one + " ";
    sink(all.c_str());
    return 0;
  });
}

void rotation_of_rpy(const double* rpy, double* q, double* again) {
  tf2::Quaternion rotation;
  rotation.setRPY(rpy[0], rpy[1], rpy[2]);
  for (int i = 0; i < 4; ++i) q[i] = rotation[i];
  tf2::Matrix3x3(rotation).getRPY(again[0], again[1], again[2]);
}
void through_matrix(const double* q, double* out) {
  const tf2::Quaternion again = tf2::Transform(quaternion(q)).getRotation();
  for (int i = 0; i < 4; ++i) out[i] = again[i];
}
void compose(const double* a, const double* b, double* product, double* inverse) {
  const tf2::Transform first(quaternion(a + 3), tf2::Vector3(a[0], a[1], a[2]));
  const tf2::Transform second(quaternion(b + 3), tf2::Vector3(b[0], b[1], b[2]));
  const tf2::Transform both[] = {first * second, first.inverse()};
  double* const outs[] = {product, inverse};
  for (int n = 0; n < 2; ++n) {
    const tf2::Quaternion q = both[n].getRotation();
    for (int i = 0; i < 3; ++i) outs[n][i] = both[n].getOrigin()[i];
    for (int i = 0; i < 4; ++i) outs[n][3 + i] = q[i];
  }
}
double eigen_check(const double* m, double* diagonal) {
  tf2::Matrix3x3 matrix(m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5]), rot;
  const tf2::Matrix3x3 before = matrix;
  matrix.diagonalize(rot, 1e-15, 100);
  for (int i = 0; i < 3; ++i) diagonal[i] = matrix[i][i];
  const tf2::Matrix3x3 again = rot * matrix.timesTranspose(rot);
  double worst = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::fabs(again[i][j] - before[i][j]));
  return worst;
}
double shortest_with_limits(double from, double to, double left, double right, int* is_inside) {
  double way = 0.0;
  *is_inside = angles::shortest_angular_distance_with_limits(from, to, left, right, way);
  return way;
}

void arm_pose(const double* q, double* pose) {
  const KDL::Chain chain = arm();
  KDL::Frame tip;
  KDL::ChainFkSolverPos_recursive(chain).JntToCart(joints(q), tip);
  put(tip, pose);
}
void arm_jacobian(const double* q, double* jacobian) {
  const KDL::Chain chain = arm();
  KDL::Jacobian out(6);
  KDL::ChainJntToJacSolver(chain).JntToJac(joints(q), out);
  for (unsigned row = 0; row < 6; ++row)
    for (unsigned column = 0; column < 6; ++column) jacobian[6 * row + column] = out(row, column);
}
void arm_velocity(const double* q, const double* rates, double* twist) {
  const KDL::Chain chain = arm();
  KDL::FrameVel tip;
  KDL::ChainFkSolverVel_recursive(chain).JntToCart(KDL::JntArrayVel(joints(q), joints(rates)), tip);
  for (int i = 0; i < 6; ++i) twist[i] = tip.GetTwist()(i);
}
int arm_inverse(int method, const double* start, const double* wanted, double* q) {
  const KDL::Chain chain = arm();
  KDL::Frame goal;
  KDL::ChainFkSolverPos_recursive fk(chain);
  fk.JntToCart(joints(wanted), goal);
  KDL::ChainIkSolverVel_pinv velocity(chain);
  KDL::ChainIkSolverVel_wdls damped(chain);
  damped.setLambda(0.01);
  KDL::ChainIkSolverPos_NR newton(chain, fk, velocity, 500, 1e-9);
  KDL::ChainIkSolverPos_NR_JL limited(chain, fk, damped, 500, 1e-9);
  KDL::ChainIkSolverPos_LMA marquardt(chain, 1e-10);
  KDL::ChainIkSolverPos* const methods[] = {&newton, &limited, &marquardt};
  KDL::JntArray out(6);
  const int result = methods[method]->CartToJnt(joints(start), goal, out);
  put(out, q);
  return result;
}
void arm_dynamics(const double* q, const double* rates, const double* accelerations,
                  double* torques, double* mass, double* coriolis, double* gravity) {
  const KDL::Chain chain = arm();
  const KDL::Vector down(0.0, 0.0, -9.81);
  KDL::JntArray out(6), bent(6), hung(6);
  KDL::ChainIdSolver_RNE(chain, down)
      .CartToJnt(joints(q), joints(rates), joints(accelerations), KDL::Wrenches(6), out);
  put(out, torques);
  KDL::ChainDynParam parts(chain, down);
  KDL::JntSpaceInertiaMatrix inertia(6);
  parts.JntToMass(joints(q), inertia);
  parts.JntToCoriolis(joints(q), joints(rates), bent);
  parts.JntToGravity(joints(q), hung);
  put(bent, coriolis);
  put(hung, gravity);
  for (unsigned row = 0; row < 6; ++row)
    for (unsigned column = 0; column < 6; ++column) mass[6 * row + column] = inertia(row, column);
}
// Up one branch and down another: the same as both from the root.
double tree_chain_error(const double* q) {
  KDL::Tree tree("base");
  const KDL::Chain chain = arm();
  tree.addChain(chain, "base");
  KDL::Chain other;
  for (int i = 0; i < 2; ++i)
    other.addSegment(KDL::Segment("side" + std::to_string(i),
                                  KDL::Joint("s" + std::to_string(i), KDL::Joint::RotX),
                                  KDL::Frame(KDL::Vector(0.1, 0.2, 0.3))));
  tree.addChain(other, "link1");
  KDL::Chain between;
  if (!tree.getChain("side1", "link5", between)) return 1e9;
  KDL::JntArray all(between.getNrOfJoints()), whole(tree.getNrOfJoints());
  for (unsigned i = 0; i < whole.rows(); ++i) whole(i) = q[i];
  all(0) = whole(7);
  all(1) = whole(6);
  for (unsigned i = 2; i < 6; ++i) all(i) = whole(i);
  KDL::Frame found, left, right;
  KDL::ChainFkSolverPos_recursive(between).JntToCart(all, found);
  KDL::TreeFkSolverPos_recursive fk(tree);
  fk.JntToCart(whole, left, "side1");
  fk.JntToCart(whole, right, "link5");
  const KDL::Twist error = KDL::diff(left.Inverse() * right, found);
  return error.vel.Norm() + error.rot.Norm();
}

unsigned scan_cloud(const float* settings, const float* ranges, const float* intensities,
                    unsigned count, double cutoff, int channels, std::uint8_t* data, Sink sink) {
  Scan scan{"", settings[0], settings[1], settings[2], settings[3], settings[4], {}, {}};
  scan.ranges.assign(ranges, ranges + count);
  scan.intensities.assign(intensities, intensities + count);
  Cloud cloud;
  gazelle::laser_cloud2(scan, gazelle::laser_points(scan, cutoff), channels, cloud);
  std::string fields;
  for (const Field& field : cloud.fields)
    fields += field.name + ":" + std::to_string(field.offset) + ":" +
              std::to_string(field.datatype) + " ";
  sink(fields.c_str());
  std::memcpy(data, cloud.data.data(), cloud.data.size());
  return static_cast<unsigned>(cloud.data.size());
}

}  // extern "C"
