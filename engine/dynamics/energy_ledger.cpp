#include "engine/dynamics/energy_ledger.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

namespace {

struct Touch {
  double overlap = 0.0;  ///< δ [m]
  double R_eff = 0.0;    ///< R* [m]
  double smaller = 0.0;  ///< the smaller radius [m]
};

double squared(const double (&v)[3]) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

void add_contact(const LawParameters& law, RollingModel model, const Touch& touch, const SpringRecord& spring,
                 const RollingRecord& rolling, ContactSurvey& survey) {
  if (!(touch.overlap > 0.0)) return;
  const double root = std::sqrt(touch.R_eff * touch.overlap);
  const double k_n = 4.0 / 3.0 * law.young * root, S_t = 8.0 * law.shear * root;
  survey.elastic_normal += 0.4 * k_n * touch.overlap * touch.overlap;
  survey.elastic_tangential +=
      0.5 * squared(spring.value) * (law.history == TangentialHistory::force ? 1.0 / S_t : S_t);
  const double k_r = (model == RollingModel::type_c ? 2.25 * law.rolling * law.rolling * k_n : S_t) *
                     touch.R_eff * touch.R_eff;
  if (has_rolling_spring(model) && k_r > 0.0) survey.elastic_rolling += 0.5 * squared(rolling.torque) / k_r;
  const double ratio = touch.overlap / touch.smaller;
  survey.largest_overlap = std::max(survey.largest_overlap, ratio);
  survey.mean_overlap += (ratio - survey.mean_overlap) / static_cast<double>(++survey.contacts);
}

RollingRecord rolling_of(const NearList& contacts, std::size_t k) {
  return contacts.rolls ? contacts.rolling[k] : RollingRecord{};
}

Touch touch_of(const PlacedSphere& a, const PlacedSphere& b) {
  return {a.radius + b.radius - (Vec3(a.centre) - Vec3(b.centre)).norm(),
          a.radius * b.radius / (a.radius + b.radius), std::min(a.radius, b.radius)};
}

}  // namespace

ContactSurvey survey_contacts(const ForceStep& step, RollingModel model, const Bodies& bodies,
                              const ContactList& contacts, std::span<const Wall> walls) {
  ContactSurvey survey;
  if (bodies.count == 0) return survey;
  const std::span<const PlacedSphere> placed = contacts.placed;
  contacts.for_each_pair([&](const NearList& near, std::size_t k) {
    add_contact(step.pair_law, model, touch_of(near.first(placed, k), near.second(placed, k)), near.spring[k],
                rolling_of(near, k), survey);
  });
  contacts.for_each_at_wall([&](const NearList& near, std::size_t k) {
    const PlacedSphere& s = near.first(placed, k);
    const WallDistance wall = distance_to(walls[near.wall(k)], Vec3(s.centre));
    add_contact(step.wall_law, model, {s.radius - wall.distance, s.radius, s.radius}, near.spring[k],
                rolling_of(near, k), survey);
  });
  return survey;
}

BodyEnergy energy_of(const Bodies& bodies, std::size_t i, double dt, Integrator integrator) {
  const double m = bodies.motion[i].mass;
  const BodyLoad& load = bodies.load[i];
  const Vec3 v = bodies.velocity(i), w = bodies.angular_velocity(i);
  const Vec3 dv = dt * (Vec3(load.force) / m - kGravity * Vec3::UnitZ());
  const bool half = integrator != Integrator::explicit_euler;  // v belongs to half a step after the forces
  const Vec3 now = v - (half ? 0.5 : 1.0) * dv;
  const double z = bodies.z[i] - dt * (half ? v : now).z();
  const Vec3 L(bodies.lx[i], bodies.ly[i], bodies.lz[i]);
  const double spin = 0.5 * w.dot(L) - (half ? 0.5 : 1.0) * dt * w.dot(Vec3(load.torque));
  return {0.5 * m * now.squaredNorm() + std::max(spin, 0.0), m * kGravity * z};
}

}  // namespace repose
