#pragma once

#include <cmath>

#include "engine/base/vec3.hpp"
#include "engine/contact/contact_law.hpp"

namespace repose::test {

/// A contact that is led along a path of overlaps and positions in its plane, and the work that is done on
/// it. Seen from a frame of the caller's choice: turned, and moving with a constant velocity.
class LedContact {
 public:
  explicit LedContact(const LawParameters& law, const Quat& frame = Quat::Identity(),
                      const Vec3& boost = Vec3::Zero())
      : law_(law), frame_(frame), boost_(boost) {}

  /// Leads the contact to an overlap and a position (z counts for nothing) in `steps` equal parts; returns
  /// the work done on it: the mean of the forces at a step's ends times its displacement, summed.
  double lead(double overlap, const Vec3& position, int steps) {
    const double change = (overlap - overlap_) / steps;
    Vec3 step = (position - position_) / steps;
    step.z() = -change;
    double work = 0.0;
    for (int k = 0; k < steps; ++k) {
      const Vec3 before = force_;
      overlap_ = std::max(overlap_ + change, 0.0);
      move(step, Vec3::Zero());
      const double part = -(0.5 * (before + force_)).dot(step);
      work += part;
      spent_ += std::abs(part);
    }
    position_ = position;
    return work;
  }

  /// Turns both bodies and their contact as one by `angle` about an axis in the frame of the contact: no
  /// surface moves against the other, and the contact's own axes turn along.
  void turn(const Vec3& axis, double angle, int steps) {
    const Quat part(Eigen::AngleAxisd(angle / steps, axis.normalized()));
    for (int k = 0; k < steps; ++k) {
      const Vec3 w = frame_ * (axis.normalized() * (angle / steps));  // per step of unit time
      frame_ = frame_ * part;
      move(Vec3::Zero(), w);
    }
  }

  [[nodiscard]] double spent() const { return spent_; }       ///< Σ |work| of all steps
  [[nodiscard]] const Vec3& force() const { return force_; }  ///< on i, in the contact's frame

 private:
  static Triple<double> triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

  void move(const Vec3& velocity, const Vec3& w) {
    const ContactGeometry<double> geometry{triple(frame_ * Vec3::UnitZ()), overlap_, 1e-3, 1e-3, 0.0, 1e3};
    const ContactSide<double> i{triple(frame_ * velocity + boost_), triple(w), triple(Vec3::Zero())};
    const ContactSide<double> j{triple(boost_), triple(w), triple(Vec3::Zero())};
    const ContactForces<double> f = contact_forces<RollingModel::type_a>(
        law_, geometry, relative_motion(geometry.n, i, j), {1.0}, history_);
    force_ = frame_.conjugate() * Vec3(f.force.x, f.force.y, f.force.z);
  }

  LawParameters law_;
  Quat frame_;
  Vec3 boost_;
  ContactHistory<double> history_{};
  Vec3 position_ = Vec3::Zero();
  Vec3 force_ = Vec3::Zero();
  double overlap_ = 0.0;
  double spent_ = 0.0;
};

}  // namespace repose::test
