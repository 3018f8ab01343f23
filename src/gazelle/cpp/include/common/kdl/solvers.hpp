// Solvers over chains and trees: positions, velocities, Jacobians, their inverses, dynamics.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "kdl/chain.hpp"
#include "kdl/jntarray.hpp"
#include "kdl/jntarrayvel.hpp"
#include "kdl/tree.hpp"

namespace KDL {

typedef std::vector<Wrench> Wrenches;

class GAZELLE_KDL SolverI {
 public:
  enum {
    E_DEGRADED = +1,  // solved, but not as well as asked
    E_NOERROR = 0,
    E_NO_CONVERGE = -1,
    E_UNDEFINED = -2,
    E_NOT_UP_TO_DATE = -3,
    E_SIZE_MISMATCH = -4,
    E_MAX_ITERATIONS_EXCEEDED = -5,
    E_OUT_OF_RANGE = -6,
    E_NOT_IMPLEMENTED = -7,
    E_SVD_FAILED = -8,
  };

  virtual ~SolverI() = default;
  virtual int getError() const { return error; }
  virtual const char* strError(const int error) const;
  virtual void updateInternalDataStructures() {}

 protected:
  int error = E_NOERROR;
};

// ---- Forward ----------------------------------------------------------------------------------

class GAZELLE_KDL ChainFkSolverPos : public SolverI {
 public:
  // A negative segment number asks for the tip.
  virtual int JntToCart(const JntArray& q_in, Frame& p_out, int segmentNr = -1) = 0;
  virtual int JntToCart(const JntArray& q_in, std::vector<Frame>& p_out, int segmentNr = -1) = 0;
};

class GAZELLE_KDL ChainFkSolverPos_recursive : public ChainFkSolverPos {
 public:
  explicit ChainFkSolverPos_recursive(const Chain& chain) : chain_(chain) {}
  int JntToCart(const JntArray& q_in, Frame& p_out, int segmentNr = -1) override;
  int JntToCart(const JntArray& q_in, std::vector<Frame>& p_out, int segmentNr = -1) override;

 private:
  const Chain& chain_;
};

class GAZELLE_KDL ChainFkSolverVel : public SolverI {
 public:
  virtual int JntToCart(const JntArrayVel& q_in, FrameVel& out, int segmentNr = -1) = 0;
  virtual int JntToCart(const JntArrayVel& q_in, std::vector<FrameVel>& out,
                        int segmentNr = -1) = 0;
};

class GAZELLE_KDL ChainFkSolverVel_recursive : public ChainFkSolverVel {
 public:
  explicit ChainFkSolverVel_recursive(const Chain& chain) : chain_(chain) {}
  int JntToCart(const JntArrayVel& q_in, FrameVel& out, int segmentNr = -1) override;
  int JntToCart(const JntArrayVel& q_in, std::vector<FrameVel>& out, int segmentNr = -1) override;

 private:
  const Chain& chain_;
};

// The Jacobian at the tip, along the base's axes.
class GAZELLE_KDL ChainJntToJacSolver : public SolverI {
 public:
  explicit ChainJntToJacSolver(const Chain& chain);
  int JntToJac(const JntArray& q_in, Jacobian& jac, int segmentNR = -1);
  int setLockedJoints(const std::vector<bool> locked_joints);
  void updateInternalDataStructures() override;

 private:
  const Chain& chain_;
  std::vector<bool> locked_;
};

// ---- Inverse ----------------------------------------------------------------------------------

class GAZELLE_KDL ChainIkSolverVel : public SolverI {
 public:
  virtual int CartToJnt(const JntArray& q_in, const Twist& v_in, JntArray& qdot_out) = 0;
};

class GAZELLE_KDL ChainIkSolverPos : public SolverI {
 public:
  virtual int CartToJnt(const JntArray& q_init, const Frame& p_in, JntArray& q_out) = 0;
};

// By the pseudoinverse; singular values below eps count as zero.
class GAZELLE_KDL ChainIkSolverVel_pinv : public ChainIkSolverVel {
 public:
  static const int E_CONVERGE_PINV_SINGULAR = +100;

  explicit ChainIkSolverVel_pinv(const Chain& chain, double eps = 0.00001, int maxiter = 150);
  int CartToJnt(const JntArray& q_in, const Twist& v_in, JntArray& qdot_out) override;
  unsigned int getNrZeroSigmas() const { return zero_sigmas_; }
  const char* strError(const int error) const override;

 private:
  const Chain& chain_;
  ChainJntToJacSolver jacobian_;
  double eps_;
  unsigned int zero_sigmas_ = 0;
};

// Damped least squares with weights.
class GAZELLE_KDL ChainIkSolverVel_wdls : public ChainIkSolverVel {
 public:
  static const int E_CONVERGE_PINV_SINGULAR = +100;

  explicit ChainIkSolverVel_wdls(const Chain& chain, double eps = 0.00001, int maxiter = 150);
  int CartToJnt(const JntArray& q_in, const Twist& v_in, JntArray& qdot_out) override;
  int setWeightJS(const Eigen::MatrixXd& Mq);
  int setWeightTS(const Eigen::MatrixXd& Mx);
  void setLambda(const double lambda) { lambda_ = lambda; }
  void setEps(const double eps) { eps_ = eps; }

 private:
  const Chain& chain_;
  ChainJntToJacSolver jacobian_;
  double eps_;
  double lambda_ = 0.0;
  Eigen::MatrixXd weight_js_, weight_ts_;
};

// Newton and Raphson.
class GAZELLE_KDL ChainIkSolverPos_NR : public ChainIkSolverPos {
 public:
  static const int E_IKSOLVER_FAILED = -100;
  static const int E_FKSOLVERPOS_FAILED = -101;

  ChainIkSolverPos_NR(const Chain& chain, ChainFkSolverPos& fksolver, ChainIkSolverVel& iksolver,
                      unsigned int maxiter = 100, double eps = 1e-6)
      : chain_(chain), fk_(fksolver), ik_(iksolver), maxiter_(maxiter), eps_(eps) {}
  int CartToJnt(const JntArray& q_init, const Frame& p_in, JntArray& q_out) override;

 protected:
  // After each step.
  virtual void limit(JntArray&) const {}

  const Chain& chain_;

 private:
  ChainFkSolverPos& fk_;
  ChainIkSolverVel& ik_;
  unsigned int maxiter_;
  double eps_;
};

// The same within the joints' limits.
class GAZELLE_KDL ChainIkSolverPos_NR_JL : public ChainIkSolverPos_NR {
 public:
  ChainIkSolverPos_NR_JL(const Chain& chain, const JntArray& q_min, const JntArray& q_max,
                         ChainFkSolverPos& fksolver, ChainIkSolverVel& iksolver,
                         unsigned int maxiter = 100, double eps = 1e-6)
      : ChainIkSolverPos_NR(chain, fksolver, iksolver, maxiter, eps), min_(q_min), max_(q_max) {}
  ChainIkSolverPos_NR_JL(const Chain& chain, ChainFkSolverPos& fksolver, ChainIkSolverVel& iksolver,
                         unsigned int maxiter = 100, double eps = 1e-6);
  int setJointLimits(const JntArray& q_min, const JntArray& q_max);

 protected:
  void limit(JntArray& q) const override;

 private:
  JntArray min_, max_;
};

// Levenberg and Marquardt.
class GAZELLE_KDL ChainIkSolverPos_LMA : public ChainIkSolverPos {
 public:
  static const int E_GRADIENT_JOINTS_TOO_SMALL = -100;
  static const int E_INCREMENT_JOINTS_TOO_SMALL = -101;

  ChainIkSolverPos_LMA(const Chain& chain, const Eigen::Matrix<double, 6, 1>& L, double eps = 1e-5,
                       int maxiter = 500, double eps_joints = 1e-15);
  explicit ChainIkSolverPos_LMA(const Chain& chain, double eps = 1e-5, int maxiter = 500,
                                double eps_joints = 1e-15);
  int CartToJnt(const JntArray& q_init, const Frame& p_in, JntArray& q_out) override;

 private:
  const Chain& chain_;
  ChainFkSolverPos_recursive fk_;
  ChainJntToJacSolver jacobian_;
  Eigen::Matrix<double, 6, 1> weight_;
  double eps_, eps_joints_;
  int maxiter_;
};

// ---- Dynamics ---------------------------------------------------------------------------------

class GAZELLE_KDL ChainIdSolver : public SolverI {
 public:
  virtual int CartToJnt(const JntArray& q, const JntArray& q_dot, const JntArray& q_dotdot,
                        const Wrenches& f_ext, JntArray& torques) = 0;
};

// Newton and Euler, from the base to the tip and back.
class GAZELLE_KDL ChainIdSolver_RNE : public ChainIdSolver {
 public:
  ChainIdSolver_RNE(const Chain& chain, Vector grav) : chain_(chain), gravity_(-grav, Vector()) {}
  int CartToJnt(const JntArray& q, const JntArray& q_dot, const JntArray& q_dotdot,
                const Wrenches& f_ext, JntArray& torques) override;

 private:
  const Chain& chain_;
  Twist gravity_;
};

class GAZELLE_KDL ChainDynParam : public SolverI {
 public:
  ChainDynParam(const Chain& chain, Vector grav)
      : chain_(chain), at_rest_(chain, Vector()), hanging_(chain, grav) {}
  int JntToCoriolis(const JntArray& q, const JntArray& q_dot, JntArray& coriolis);
  int JntToMass(const JntArray& q, JntSpaceInertiaMatrix& H);
  int JntToGravity(const JntArray& q, JntArray& gravity);

 private:
  const Chain& chain_;
  ChainIdSolver_RNE at_rest_, hanging_;
};

// ---- Trees ------------------------------------------------------------------------------------

class GAZELLE_KDL TreeFkSolverPos_recursive {
 public:
  explicit TreeFkSolverPos_recursive(const Tree& tree) : tree_(tree) {}
  int JntToCart(const JntArray& q_in, Frame& p_out, std::string segmentName);

 private:
  Tree tree_;
};

class GAZELLE_KDL TreeJntToJacSolver {
 public:
  explicit TreeJntToJacSolver(const Tree& tree) : tree_(tree) {}
  int JntToJac(const JntArray& q_in, Jacobian& jac, const std::string& segmentname);

 private:
  Tree tree_;
};

}  // namespace KDL
