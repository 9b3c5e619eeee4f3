#include "engine/slump/motion_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace repose {

namespace {

double diameter_of(const Bodies& bodies, std::size_t i) {
  return std::cbrt(6.0 * bodies.motion[i].mass / (kPi * bodies.density));
}

double softest_axis(const Bodies& bodies, std::size_t i) {
  return std::max({bodies.inverse_i1[i], bodies.inverse_i2[i], bodies.inverse_i3[i]});
}

/// What a normal and a tangential coefficient (k or c) of one contact do to one of its bodies, over its
/// inertia.
double over_inertia(const Bodies& bodies, std::size_t i, const Vec3& arm, const Vec3& n, double normal,
                    double tangential) {
  const double lightness = 1.0 / bodies.motion[i].mass;
  const double softest = softest_axis(bodies, i);
  return std::max(normal * (lightness + softest * arm.cross(n).squaredNorm()),
                  tangential * (lightness + softest * arm.squaredNorm()));
}

/// A contact of the last step, as far as the watch needs it.
struct SeenContact {
  const LawParameters* law = nullptr;
  Vec3 n = Vec3::UnitZ();
  double overlap = 0.0;         ///< δ [m]
  double R_eff = 0.0;           ///< R* [m]
  double m_eff = 0.0;           ///< m* [kg]
  double smaller_radius = 0.0;  ///< [m]
  double diameter = 0.0;        ///< mean of the two bodies [m]
  std::size_t sides = 2;        ///< 1: with a wall
  std::size_t body[2] = {};
  Vec3 arm[2];
};

template <class Visit>
void for_each_contact(const Simulation& simulation, Visit visit) {
  const Bodies& bodies = simulation.bodies();
  const ContactList& list = simulation.contacts();
  // Spheres are where they were before the last motion.
  const auto arm = [&](const PlacedSphere& sphere, std::size_t body) -> Vec3 {
    return Vec3(sphere.centre) - (bodies.position(body) - simulation.dt() * bodies.velocity(body));
  };
  SeenContact contact;
  contact.law = &simulation.laws().pair_law;
  list.for_each_pair([&](const NearList& near, std::size_t k) {
    const PlacedSphere& a = near.first(list.placed, k);
    const PlacedSphere& b = near.second(list.placed, k);
    const Vec3 apart = Vec3(a.centre) - Vec3(b.centre);
    const double distance = apart.norm();
    contact.overlap = a.radius + b.radius - distance;
    if (!(contact.overlap > 0.0 && distance > 0.0)) return;
    contact.n = apart / distance;
    const std::size_t i = near.first_body(k), j = near.second_body(k);
    const double m_i = bodies.motion[i].mass, m_j = bodies.motion[j].mass;
    contact.R_eff = a.radius * b.radius / (a.radius + b.radius);
    contact.m_eff = m_i * m_j / (m_i + m_j);
    contact.smaller_radius = std::min(a.radius, b.radius);
    contact.diameter = 0.5 * (diameter_of(bodies, i) + diameter_of(bodies, j));
    contact.body[0] = i, contact.body[1] = j;
    contact.arm[0] = arm(a, i) - (a.radius - 0.5 * contact.overlap) * contact.n;
    contact.arm[1] = arm(b, j) + (b.radius - 0.5 * contact.overlap) * contact.n;
    visit(contact);
  });
  contact.law = &simulation.laws().wall_law;
  contact.sides = 1;
  list.for_each_at_wall([&](const NearList& near, std::size_t k) {
    const PlacedSphere& a = near.first(list.placed, k);
    const WallDistance wall = distance_to(simulation.walls[near.wall(k)], Vec3(a.centre));
    contact.overlap = a.radius - wall.distance;
    if (!(contact.overlap > 0.0)) return;
    const std::size_t i = near.first_body(k);
    contact.n = wall.normal;
    contact.R_eff = contact.smaller_radius = a.radius;
    contact.m_eff = bodies.motion[i].mass;
    contact.diameter = diameter_of(bodies, i);
    contact.body[0] = i;
    contact.arm[0] = arm(a, i) - (a.radius - 0.5 * contact.overlap) * contact.n;
    visit(contact);
  });
}

}  // namespace

MotionWatch::MotionWatch(const Scene& scene) : scene_(scene) {
  const ContactModel& contact = scene.contact;
  if (std::max(contact.particle_particle.static_friction, contact.particle_wall.static_friction) > 1.0)
    diagnosis_.coarse = MotionDiagnosis::kCoarseSticking;
}

bool MotionWatch::spilled(const Bodies& bodies, std::size_t i) const {
  const SlumpTest& test = scene_.test;
  return closed_ && std::hypot(bodies.x[i], bodies.y[i]) > test.cylinder_radius &&
         bodies.z[i] > test.cylinder_height - bodies.reach[i];
}

void MotionWatch::count_spilled(const Bodies& bodies, std::size_t i) {
  ++diagnosis_.spilled;
  diagnosis_.spilled_mass += bodies.motion[i].mass;
}

std::optional<Verdict> MotionWatch::check_bodies(const Simulation& simulation) const {
  const Bodies& bodies = simulation.bodies();
  const SlumpTest& test = scene_.test;
  double sum = 0.0;
  int through_base = 0, through_cylinder = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    sum += bodies.kinetic_energy(i) + bodies.x[i] + bodies.y[i] + bodies.z[i];
    const double rho = std::hypot(bodies.x[i], bodies.y[i]);
    const bool below = bodies.z[i] < 0.0 && rho < test.base_radius - bodies.reach[i];
    const bool outside = closed_ && rho > test.cylinder_radius && !spilled(bodies, i);
    through_base += below ? 1 : 0;
    through_cylinder += outside ? 1 : 0;
    if (below || outside) where = i;
  }
  if (!std::isfinite(sum))
    return Verdict{
        Outcome::diverged,
        fmt::format("a number of the motion is not finite at {:.4g} s with a step of {:.3g} s; use a "
                    "smaller one",
                    simulation.time(), simulation.dt())};
  if (through_base + through_cylinder == 0) return std::nullopt;
  return Verdict{
      Outcome::escaped,
      fmt::format(
          "{} bodies went through the base and {} through the cylinder by {:.4g} s, one to x = {:.1f}, y = "
          "{:.1f}, z = {:.1f} mm; use a smaller step (now {:.3g} s) or stiffer contacts",
          through_base, through_cylinder, simulation.time(), 1e3 * bodies.x[where], 1e3 * bodies.y[where],
          1e3 * bodies.z[where], simulation.dt())};
}

MotionWatch::ContactSums MotionWatch::sum_contacts(const Simulation& simulation) const {
  const Bodies& bodies = simulation.bodies();
  ContactSums sums;
  sums.stiffness.assign(bodies.count, 0.0);
  sums.damping.assign(bodies.count, 0.0);
  for_each_contact(simulation, [&](const SeenContact& contact) {
    const LawParameters& law = *contact.law;
    const double root = std::sqrt(contact.R_eff * contact.overlap);
    sums.overlap_ratio_sum += contact.overlap / contact.diameter;
    sums.largest_ratio = std::max(sums.largest_ratio, contact.overlap / contact.smaller_radius);
    ++sums.count;
    const double S_n = 2.0 * law.young * root, S_t = 8.0 * law.shear * root;
    const double root_normal = std::sqrt(S_n * contact.m_eff);
    for (std::size_t side = 0; side < contact.sides; ++side) {
      const auto i = contact.body[side];
      const auto both = static_cast<double>(contact.sides);
      sums.stiffness[i] += both * over_inertia(bodies, i, contact.arm[side], contact.n, S_n, S_t);
      sums.damping[i] +=
          both * over_inertia(bodies, i, contact.arm[side], contact.n, law.normal_damping * root_normal,
                              law.tangent_damping * root_normal);
    }
  });
  return sums;
}

std::optional<Verdict> MotionWatch::check_contacts(const Simulation& simulation) {
  const double imbalance = simulation.ledger().relative_imbalance();
  if (!(std::abs(imbalance) <= std::abs(diagnosis_.energy_imbalance)))
    diagnosis_.energy_imbalance = imbalance;
  const ContactSums sums = sum_contacts(simulation);
  diagnosis_.largest_overlap_ratio = std::max(diagnosis_.largest_overlap_ratio, sums.largest_ratio);
  const double dt = simulation.dt();
  for (std::size_t i = 0; i < sums.stiffness.size(); ++i) {
    diagnosis_.stiffest = std::max(diagnosis_.stiffest, sums.stiffness[i]);
    diagnosis_.stability_number =
        std::max(diagnosis_.stability_number, 0.25 * dt * (dt * sums.stiffness[i] + 2.0 * sums.damping[i]));
  }
  return judge(diagnosis_, simulation.time(), dt);
}

std::optional<Verdict> MotionWatch::check_column(const Simulation& simulation) {
  const ContactSums sums = sum_contacts(simulation);
  diagnosis_.column_overlap_ratio = sums.count > 0 ? sums.overlap_ratio_sum / sums.count : 0.0;
  return judge(diagnosis_, simulation.time(), simulation.dt());
}

std::optional<Verdict> judge(const MotionDiagnosis& diagnosis, double time, double dt) {
  if (!(std::abs(diagnosis.energy_imbalance) <= MotionDiagnosis::kMostImbalance))
    return Verdict{
        Outcome::unstable,
        fmt::format(
            "by {:.4g} s the energy ledger is off by {:+.3g} % of what was put in (bar: {:.0f} %): the step "
            "of "
            "{:.3g} s is too large (stability number {:.1f}, coarse from {:.0f} on); use a smaller one{}",
            time, 100.0 * diagnosis.energy_imbalance, 100.0 * MotionDiagnosis::kMostImbalance, dt,
            diagnosis.stability_number, diagnosis.coarse,
            diagnosis.stability_number < diagnosis.coarse
                ? ", or another integrator, and no unlimited rolling torque: contacts alone would bear it"
                : "")};
  if (!(diagnosis.column_overlap_ratio <= MotionDiagnosis::kDeepest))
    return Verdict{
        Outcome::overlapping,
        fmt::format("particles of the settled column overlap by {:.2g} % of their diameter in the mean (bar: "
                    "{:.2g} %): contacts are too soft to carry them; raise /numerics/stiffness_scale or the "
                    "shear modulus",
                    100.0 * diagnosis.column_overlap_ratio, 100.0 * MotionDiagnosis::kDeepest)};
  return std::nullopt;
}

}  // namespace repose
