#include "kdl/solvers.hpp"

#include <Eigen/SVD>
#include <algorithm>

namespace KDL {

const char* SolverI::strError(const int error) const {
  switch (error) {
    case E_NOERROR:
      return "No error";
    case E_NO_CONVERGE:
      return "Failed to converge";
    case E_UNDEFINED:
      return "Undefined value";
    case E_DEGRADED:
      return "Converged but degraded solution";
    case E_NOT_UP_TO_DATE:
      return "Internal data structures not up to date with Chain";
    case E_SIZE_MISMATCH:
      return "The size of the input does not match the internal state";
    case E_MAX_ITERATIONS_EXCEEDED:
      return "The maximum number of iterations is exceeded";
    case E_OUT_OF_RANGE:
      return "The requested index is out of range";
    case E_NOT_IMPLEMENTED:
      return "The requested function is not yet implemented";
    case E_SVD_FAILED:
      return "SVD failed";
    default:
      return "UNKNOWN ERROR";
  }
}

namespace {

// How many segments a number means, -1 where it means none.
int count_of(const Chain& chain, int number) {
  const int all = static_cast<int>(chain.getNrOfSegments());
  if (number < 0) return all;
  return number > all ? -1 : number;
}

bool moves(const Segment& segment) { return segment.getJoint().getType() != Joint::Fixed; }

}  // namespace

// ---- Forward ----------------------------------------------------------------------------------

int ChainFkSolverPos_recursive::JntToCart(const JntArray& q_in, Frame& p_out, int segmentNr) {
  std::vector<Frame> frames(static_cast<std::size_t>(std::max(count_of(chain_, segmentNr), 0)));
  const int result = JntToCart(q_in, frames, segmentNr);
  if (result == E_NOERROR) p_out = frames.empty() ? Frame() : frames.back();
  return result;
}

int ChainFkSolverPos_recursive::JntToCart(const JntArray& q_in, std::vector<Frame>& p_out,
                                          int segmentNr) {
  const int count = count_of(chain_, segmentNr);
  if (q_in.rows() != chain_.getNrOfJoints()) return error = E_SIZE_MISMATCH;
  if (count < 0) return error = E_OUT_OF_RANGE;
  if (p_out.size() != static_cast<std::size_t>(count)) return error = E_SIZE_MISMATCH;
  Frame here;
  unsigned int joint = 0;
  for (int i = 0; i < count; ++i) {
    const Segment& segment = chain_.getSegment(i);
    here = here * segment.pose(moves(segment) ? q_in(joint++) : 0.0);
    p_out[i] = here;
  }
  return error = E_NOERROR;
}

int ChainFkSolverVel_recursive::JntToCart(const JntArrayVel& q_in, FrameVel& out, int segmentNr) {
  std::vector<FrameVel> frames(static_cast<std::size_t>(std::max(count_of(chain_, segmentNr), 0)));
  const int result = JntToCart(q_in, frames, segmentNr);
  if (result == E_NOERROR) out = frames.empty() ? FrameVel() : frames.back();
  return result;
}

int ChainFkSolverVel_recursive::JntToCart(const JntArrayVel& q_in, std::vector<FrameVel>& out,
                                          int segmentNr) {
  const int count = count_of(chain_, segmentNr);
  if (q_in.q.rows() != chain_.getNrOfJoints() || q_in.qdot.rows() != chain_.getNrOfJoints())
    return error = E_SIZE_MISMATCH;
  if (count < 0) return error = E_OUT_OF_RANGE;
  if (out.size() != static_cast<std::size_t>(count)) return error = E_SIZE_MISMATCH;
  Frame here;
  Twist twist;
  unsigned int joint = 0;
  for (int i = 0; i < count; ++i) {
    const Segment& segment = chain_.getSegment(i);
    const double q = moves(segment) ? q_in.q(joint) : 0.0;
    const double qdot = moves(segment) ? q_in.qdot(joint) : 0.0;
    if (moves(segment)) ++joint;
    const Frame step = segment.pose(q);
    twist = twist.RefPoint(here.M * step.p) + here.M * segment.twist(q, qdot);
    here = here * step;
    out[i] = FrameVel(here, twist);
  }
  return error = E_NOERROR;
}

ChainJntToJacSolver::ChainJntToJacSolver(const Chain& chain)
    : chain_(chain), locked_(chain.getNrOfJoints(), false) {}

void ChainJntToJacSolver::updateInternalDataStructures() {
  locked_.resize(chain_.getNrOfJoints(), false);
}

int ChainJntToJacSolver::setLockedJoints(const std::vector<bool> locked_joints) {
  if (locked_joints.size() != locked_.size()) return error = E_SIZE_MISMATCH;
  locked_ = locked_joints;
  return error = E_NOERROR;
}

int ChainJntToJacSolver::JntToJac(const JntArray& q_in, Jacobian& jac, int segmentNR) {
  if (locked_.size() != chain_.getNrOfJoints()) return error = E_NOT_UP_TO_DATE;
  const int count = count_of(chain_, segmentNR);
  const auto free = static_cast<unsigned int>(std::count(locked_.begin(), locked_.end(), false));
  if (q_in.rows() != chain_.getNrOfJoints() || jac.columns() != free)
    return error = E_SIZE_MISMATCH;
  if (count < 0) return error = E_OUT_OF_RANGE;
  SetToZero(jac);
  Frame here;
  unsigned int joint = 0, column = 0;
  for (int i = 0; i < count; ++i) {
    const Segment& segment = chain_.getSegment(i);
    const double q = moves(segment) ? q_in(joint) : 0.0;
    const Frame next = here * segment.pose(q);
    jac.changeRefPoint(next.p - here.p);
    if (moves(segment)) {
      if (!locked_[joint]) jac.setColumn(column++, here.M * segment.twist(q, 1.0));
      ++joint;
    }
    here = next;
  }
  return error = E_NOERROR;
}

// ---- Inverse ----------------------------------------------------------------------------------

namespace {

using Twist6 = Eigen::Matrix<double, 6, 1>;

Twist6 as_eigen(const Twist& t) {
  Twist6 out;
  for (int i = 0; i < 6; ++i) out(i) = t(i);
  return out;
}

}  // namespace

ChainIkSolverVel_pinv::ChainIkSolverVel_pinv(const Chain& chain, double eps, int)
    : chain_(chain), jacobian_(chain), eps_(eps) {}

const char* ChainIkSolverVel_pinv::strError(const int error) const {
  return error == E_CONVERGE_PINV_SINGULAR ? "Converged put pseudo inverse of jacobian is singular."
                                           : SolverI::strError(error);
}

int ChainIkSolverVel_pinv::CartToJnt(const JntArray& q_in, const Twist& v_in, JntArray& qdot_out) {
  const unsigned int count = chain_.getNrOfJoints();
  if (q_in.rows() != count || qdot_out.rows() != count) return error = E_SIZE_MISMATCH;
  Jacobian jac(count);
  error = jacobian_.JntToJac(q_in, jac);
  if (error < E_NOERROR) return error;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jac.data, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd along = svd.matrixU().transpose() * as_eigen(v_in);
  Eigen::VectorXd scaled = Eigen::VectorXd::Zero(along.size());
  zero_sigmas_ = 0;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double sigma = svd.singularValues()(i);
    if (std::fabs(sigma) < eps_) {
      ++zero_sigmas_;
    } else {
      scaled(i) = along(i) / sigma;
    }
  }
  qdot_out.data = svd.matrixV() * scaled;
  const unsigned int rank_wanted = std::min(6U, count);
  const bool is_singular = zero_sigmas_ > static_cast<unsigned int>(along.size()) - rank_wanted;
  return error = is_singular ? E_CONVERGE_PINV_SINGULAR : static_cast<int>(E_NOERROR);
}

ChainIkSolverVel_wdls::ChainIkSolverVel_wdls(const Chain& chain, double eps, int)
    : chain_(chain),
      jacobian_(chain),
      eps_(eps),
      weight_js_(Eigen::MatrixXd::Identity(chain.getNrOfJoints(), chain.getNrOfJoints())),
      weight_ts_(Eigen::MatrixXd::Identity(6, 6)) {}

int ChainIkSolverVel_wdls::setWeightJS(const Eigen::MatrixXd& Mq) {
  if (Mq.rows() != weight_js_.rows() || Mq.cols() != weight_js_.cols())
    return error = E_SIZE_MISMATCH;
  weight_js_ = Mq;
  return error = E_NOERROR;
}

int ChainIkSolverVel_wdls::setWeightTS(const Eigen::MatrixXd& Mx) {
  if (Mx.rows() != 6 || Mx.cols() != 6) return error = E_SIZE_MISMATCH;
  weight_ts_ = Mx;
  return error = E_NOERROR;
}

int ChainIkSolverVel_wdls::CartToJnt(const JntArray& q_in, const Twist& v_in, JntArray& qdot_out) {
  const unsigned int count = chain_.getNrOfJoints();
  if (q_in.rows() != count || qdot_out.rows() != count) return error = E_SIZE_MISMATCH;
  Jacobian jac(count);
  error = jacobian_.JntToJac(q_in, jac);
  if (error < E_NOERROR) return error;
  const Eigen::MatrixXd weighted = weight_ts_ * jac.data * weight_js_;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(weighted, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd along = svd.matrixU().transpose() * (weight_ts_ * as_eigen(v_in));
  Eigen::VectorXd scaled(along.size());
  bool is_singular = false;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const double sigma = svd.singularValues()(i);
    is_singular = is_singular || sigma < eps_;
    const double damped = sigma * sigma + (sigma < eps_ ? lambda_ * lambda_ : 0.0);
    scaled(i) = damped < 1e-300 ? 0.0 : along(i) * sigma / damped;
  }
  qdot_out.data = weight_js_ * (svd.matrixV() * scaled);
  return error = is_singular ? E_CONVERGE_PINV_SINGULAR : static_cast<int>(E_NOERROR);
}

int ChainIkSolverPos_NR::CartToJnt(const JntArray& q_init, const Frame& p_in, JntArray& q_out) {
  const unsigned int count = chain_.getNrOfJoints();
  if (q_init.rows() != count || q_out.rows() != count) return error = E_SIZE_MISMATCH;
  q_out = q_init;
  JntArray delta(count);
  for (unsigned int i = 0; i < maxiter_; ++i) {
    Frame here;
    if (fk_.JntToCart(q_out, here) < E_NOERROR) return error = E_FKSOLVERPOS_FAILED;
    const Twist left = diff(here, p_in);
    const int result = ik_.CartToJnt(q_out, left, delta);
    if (result < E_NOERROR) return error = E_IKSOLVER_FAILED;
    if (Equal(left, Twist::Zero(), eps_))
      return error =
                 result > E_NOERROR ? static_cast<int>(E_DEGRADED) : static_cast<int>(E_NOERROR);
    Add(q_out, delta, q_out);
    limit(q_out);
  }
  return error = E_MAX_ITERATIONS_EXCEEDED;
}

ChainIkSolverPos_NR_JL::ChainIkSolverPos_NR_JL(const Chain& chain, ChainFkSolverPos& fksolver,
                                               ChainIkSolverVel& iksolver, unsigned int maxiter,
                                               double eps)
    : ChainIkSolverPos_NR(chain, fksolver, iksolver, maxiter, eps),
      min_(chain.getNrOfJoints()),
      max_(chain.getNrOfJoints()) {
  min_.data.setConstant(-1e300);
  max_.data.setConstant(1e300);
}

int ChainIkSolverPos_NR_JL::setJointLimits(const JntArray& q_min, const JntArray& q_max) {
  if (q_min.rows() != chain_.getNrOfJoints() || q_max.rows() != chain_.getNrOfJoints())
    return error = E_SIZE_MISMATCH;
  min_ = q_min;
  max_ = q_max;
  return error = E_NOERROR;
}

void ChainIkSolverPos_NR_JL::limit(JntArray& q) const {
  q.data = q.data.cwiseMax(min_.data).cwiseMin(max_.data);
}

ChainIkSolverPos_LMA::ChainIkSolverPos_LMA(const Chain& chain, const Eigen::Matrix<double, 6, 1>& L,
                                           double eps, int maxiter, double eps_joints)
    : chain_(chain),
      fk_(chain),
      jacobian_(chain),
      weight_(L),
      eps_(eps),
      eps_joints_(eps_joints),
      maxiter_(maxiter) {}

namespace {

// A radian of rotation counts as a centimetre.
Twist6 usual_weight() {
  Twist6 out;
  out << 1.0, 1.0, 1.0, 0.01, 0.01, 0.01;
  return out;
}

}  // namespace

ChainIkSolverPos_LMA::ChainIkSolverPos_LMA(const Chain& chain, double eps, int maxiter,
                                           double eps_joints)
    : ChainIkSolverPos_LMA(chain, usual_weight(), eps, maxiter, eps_joints) {}

int ChainIkSolverPos_LMA::CartToJnt(const JntArray& q_init, const Frame& p_in, JntArray& q_out) {
  const unsigned int count = chain_.getNrOfJoints();
  if (q_init.rows() != count || q_out.rows() != count) return error = E_SIZE_MISMATCH;
  const auto residual = [&](const JntArray& q) {
    Frame here;
    fk_.JntToCart(q, here);
    return Twist6(weight_.cwiseProduct(as_eigen(diff(here, p_in))));
  };
  JntArray q = q_init;
  Twist6 left = residual(q);
  double damping = 10.0, growth = 2.0;
  for (int i = 0; i < maxiter_; ++i) {
    q_out = q;
    if (left.norm() < eps_) return error = E_NOERROR;
    Jacobian jac(count);
    jacobian_.JntToJac(q, jac);
    const Eigen::MatrixXd J = weight_.asDiagonal() * jac.data;
    const Eigen::VectorXd gradient = J.transpose() * left;
    if (gradient.norm() < eps_joints_) return error = E_GRADIENT_JOINTS_TOO_SMALL;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd sigma = svd.singularValues();
    const Eigen::VectorXd scale = (sigma.array() / (sigma.array().square() + damping)).matrix();
    const Eigen::VectorXd step =
        svd.matrixV() * scale.cwiseProduct(svd.matrixU().transpose() * left);
    if (step.lpNorm<Eigen::Infinity>() < eps_joints_) return error = E_INCREMENT_JOINTS_TOO_SMALL;
    JntArray next = q;
    next.data += step;
    const Twist6 left_then = residual(next);
    const double hoped = step.dot(damping * step + gradient);
    const double rho = (left.squaredNorm() - left_then.squaredNorm()) / hoped;
    if (rho > 0.0) {
      q = next;
      left = left_then;
      const double better = 2.0 * rho - 1.0;
      damping *= std::max(1.0 / 3.0, 1.0 - better * better * better);
      growth = 2.0;
    } else {
      damping *= growth;
      growth *= 2.0;
    }
  }
  q_out = q;
  return error = left.norm() < eps_ ? static_cast<int>(E_NOERROR)
                                    : static_cast<int>(E_MAX_ITERATIONS_EXCEEDED);
}

// ---- Dynamics ---------------------------------------------------------------------------------

int ChainIdSolver_RNE::CartToJnt(const JntArray& q, const JntArray& q_dot, const JntArray& q_dotdot,
                                 const Wrenches& f_ext, JntArray& torques) {
  const unsigned int joints = chain_.getNrOfJoints(), segments = chain_.getNrOfSegments();
  if (q.rows() != joints || q_dot.rows() != joints || q_dotdot.rows() != joints ||
      torques.rows() != joints || f_ext.size() != segments)
    return error = E_SIZE_MISMATCH;
  // Everything is told in the segment's own frame.
  std::vector<Frame> pose(segments);
  std::vector<Twist> along(segments), velocity(segments), acceleration(segments);
  std::vector<Wrench> force(segments);
  unsigned int joint = 0;
  for (unsigned int i = 0; i < segments; ++i) {
    const Segment& segment = chain_.getSegment(i);
    double q_i = 0.0, qdot_i = 0.0, qdotdot_i = 0.0;
    if (moves(segment)) {
      q_i = q(joint);
      qdot_i = q_dot(joint);
      qdotdot_i = q_dotdot(joint);
      ++joint;
    }
    pose[i] = segment.pose(q_i);
    along[i] = pose[i].M.Inverse(segment.twist(q_i, 1.0));
    const Twist own = along[i] * qdot_i;
    const Twist before = i == 0 ? Twist() : velocity[i - 1];
    const Twist pushed = i == 0 ? gravity_ : acceleration[i - 1];
    velocity[i] = pose[i].Inverse(before) + own;
    acceleration[i] = pose[i].Inverse(pushed) + along[i] * qdotdot_i + velocity[i] * own;
    const RigidBodyInertia& inertia = segment.getInertia();
    force[i] = inertia * acceleration[i] + velocity[i] * (inertia * velocity[i]) - f_ext[i];
  }
  for (unsigned int i = segments; i-- > 0;) {
    const Segment& segment = chain_.getSegment(i);
    if (moves(segment)) {
      --joint;
      torques(joint) = dot(along[i], force[i]) + segment.getJoint().getInertia() * q_dotdot(joint);
    }
    if (i > 0) force[i - 1] += pose[i] * force[i];
  }
  return error = E_NOERROR;
}

int ChainDynParam::JntToCoriolis(const JntArray& q, const JntArray& q_dot, JntArray& coriolis) {
  const JntArray none(chain_.getNrOfJoints());
  const Wrenches free(chain_.getNrOfSegments());
  return error = at_rest_.CartToJnt(q, q_dot, none, free, coriolis);
}

int ChainDynParam::JntToMass(const JntArray& q, JntSpaceInertiaMatrix& H) {
  const unsigned int count = chain_.getNrOfJoints();
  if (q.rows() != count || H.rows() != count) return error = E_SIZE_MISMATCH;
  const JntArray none(count);
  const Wrenches free(chain_.getNrOfSegments());
  // A column is what one joint's acceleration alone takes.
  for (unsigned int column = 0; column < count; ++column) {
    JntArray pushed(count), torques(count);
    pushed(column) = 1.0;
    error = at_rest_.CartToJnt(q, none, pushed, free, torques);
    if (error != E_NOERROR) return error;
    H.data.col(column) = torques.data;
  }
  return error;
}

int ChainDynParam::JntToGravity(const JntArray& q, JntArray& gravity) {
  const JntArray none(chain_.getNrOfJoints());
  const Wrenches free(chain_.getNrOfSegments());
  return error = hanging_.CartToJnt(q, none, none, free, gravity);
}

// ---- Trees ------------------------------------------------------------------------------------

int TreeFkSolverPos_recursive::JntToCart(const JntArray& q_in, Frame& p_out,
                                         std::string segmentName) {
  if (q_in.rows() != tree_.getNrOfJoints()) return -1;
  auto here = tree_.getSegment(segmentName);
  if (here == tree_.getSegments().end()) return -2;
  p_out = Frame();
  for (; here != tree_.getRootSegment(); here = here->second.parent) {
    const Segment& segment = here->second.segment;
    p_out = segment.pose(moves(segment) ? q_in(here->second.q_nr) : 0.0) * p_out;
  }
  return 0;
}

int TreeJntToJacSolver::JntToJac(const JntArray& q_in, Jacobian& jac,
                                 const std::string& segmentname) {
  if (q_in.rows() != tree_.getNrOfJoints() || jac.columns() != tree_.getNrOfJoints()) return -1;
  auto here = tree_.getSegment(segmentname);
  if (here == tree_.getSegments().end()) return -2;
  SetToZero(jac);
  Frame to_tip;  // the tip, seen from the segment's own tip
  for (; here != tree_.getRootSegment(); here = here->second.parent) {
    const Segment& segment = here->second.segment;
    const double q = moves(segment) ? q_in(here->second.q_nr) : 0.0;
    const Frame step = segment.pose(q);
    const Frame from_root = step * to_tip;
    for (unsigned int i = 0; i < jac.columns(); ++i) jac.setColumn(i, step.M * jac.getColumn(i));
    if (moves(segment))
      jac.setColumn(here->second.q_nr, segment.twist(q, 1.0).RefPoint(from_root.p - step.p));
    to_tip = from_root;
  }
  return 0;
}

}  // namespace KDL
