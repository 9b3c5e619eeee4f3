#include "verification/table/impact.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

constexpr const char* kNormalSource = "Chung & Ooi 2011";

struct Published {
  const char* name;
  Material material;
  double F_max, overlap, duration;
};

/// Test 1: two equal spheres, ±10 m/s, elastic.
Rows two_spheres() {
  Rows rows;
  for (const Published& p :
       {Published{"glass", elastic_material(48e9, 0.20, 2800.0), 10696.9, 274.1e-6, 40.34e-6},
        Published{"limestone", elastic_material(20e9, 0.25, 2500.0), 7108.2, 368.3e-6, 54.20e-6}}) {
    Impact impact;
    impact.material = p.material;
    impact.other = impact.body;
    impact.contact = {1.0, 0.35, 0.0};
    impact.velocity = {10.0, 0.0, 0.0};
    impact.other_velocity = {-10.0, 0.0, 0.0};
    const Impact::Result result = impact.run();
    Worst worst(std::string("1: two elastic spheres, ") + p.name + ": force, overlap, duration, speed",
                kNormalSource, 5e-3);
    worst.add(p.F_max, result.F_max);
    worst.add(p.overlap, result.overlap_max);
    worst.add(p.duration, result.duration);
    worst.add(-10.0, result.velocity.x());
    rows.push_back(worst.row());
  }
  return rows;
}

/// Test 2: a sphere on a rigid wall, 0.2 m/s, elastic.
Rows sphere_on_wall() {
  Rows rows;
  for (const Published& p :
       {Published{"aluminium alloy", elastic_material(70e9, 0.30, 2699.0), 11370.0, 49.72e-6, 731.7e-6},
        Published{"magnesium alloy", elastic_material(40e9, 0.35, 1800.0), 7232.7, 52.12e-6, 767.1e-6}}) {
    Impact impact;
    impact.body = sphere_clump(0.1);
    impact.material = p.material;
    impact.contact = {1.0, 0.0, 0.0};
    impact.velocity = {0.2, 0.0, 0.0};
    const Impact::Result result = impact.run();
    Worst worst(std::string("2: elastic sphere on a wall, ") + p.name + ": force, overlap, duration, speed",
                kNormalSource, 5e-3);
    worst.add(p.F_max, result.F_max);
    worst.add(p.overlap, result.overlap_max);
    worst.add(p.duration, result.duration);
    worst.add(-0.2, result.velocity.x());
    rows.push_back(worst.row());
  }
  return rows;
}

/// Test 3: rebound of a sphere from a wall for e = 0.2 … 1; the elastic impact's force and duration.
Rows damped_sphere_on_wall() {
  Rows rows;
  for (const Published& p :
       {Published{"aluminium oxide", elastic_material(380e9, 0.23, 4000.0), 615.35, 0.0, 6.105e-6},
        Published{"cast iron", elastic_material(100e9, 0.25, 7000.0), 506.76, 0.0, 12.97e-6}}) {
    Worst worst(std::string("3: damped sphere on a wall, ") + p.name + ": rebound, force, duration",
                kNormalSource, 5e-3);
    for (double e = 0.2; e < 1.05; e += 0.1) {
      Impact impact;
      impact.body = sphere_clump(2.5e-3);
      impact.material = p.material;
      impact.contact = {std::min(e, 1.0), 0.0, 0.0};
      impact.velocity = {3.9, 0.0, 0.0};
      const Impact::Result result = impact.run();
      worst.add(impact.contact.restitution, -result.velocity.x() / 3.9);
      if (e < 0.99) continue;
      worst.add(p.F_max, result.F_max);
      worst.add(p.duration, result.duration);
    }
    rows.push_back(worst.row());
  }
  return rows;
}

}  // namespace

Rows normal_impact_rows() {
  Rows rows;
  for (const auto part : {two_spheres, sphere_on_wall, damped_sphere_on_wall}) {
    const Rows more = part();
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

/// The rebound is the given e at every speed, with the tail as well as clamped with its own damping. Damping
/// acts with the velocity of half a step before, so steps are small here: 1/20 000 of the contact.
Rows restitution_rows() {
  Rows rows;
  for (const auto damping : {NormalDamping::with_tail, NormalDamping::clamped}) {
    const bool tail = damping == NormalDamping::with_tail;
    Worst worst(std::string("rebound for e 0.01 … 1 at 0.01 … 10 m/s, ") + (tail ? "with tail" : "clamped"),
                tail ? "Antypov & Elliott 2011" : "Schwager & Pöschel 2007", 1e-3);
    for (const double e : {0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 0.95, 0.99, 1.0})
      for (const double speed : {0.01, 1.0, 10.0}) {
        Impact impact;
        impact.body = sphere_clump(4e-3);
        impact.material = elastic_material(5.75e10, 0.25, 4500.0);
        impact.wall = elastic_material(2e11, 0.3, 7850.0);
        impact.contact = {e, 0.0, 0.0};
        impact.damping = damping;
        impact.velocity = {speed, 0.0, 0.0};
        impact.steps_per_contact = 20000;
        worst.add(e, -impact.run().velocity.x() / speed);
      }
    rows.push_back(worst.row());
  }
  return rows;
}

}  // namespace repose::verification
