#include "engine/dynamics/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/law_parameters.hpp"
#include "engine/scene/particle_sizes.hpp"

namespace repose {

double rayleigh_time(double radius, const Material& material) {
  return kPi * radius * std::sqrt(material.density / material.shear_modulus) /
         (0.163 * material.poisson_ratio + 0.8766);
}

double rayleigh_time(double radius, const Scene& scene) {
  Material scaled = scene.particles.material;
  scaled.shear_modulus *= scene.numerics.stiffness_scale;
  return rayleigh_time(radius, scaled);
}

double fall_speed(const SlumpTest& test) {
  return std::sqrt(test.pour_speed * test.pour_speed + 2.0 * kGravity * test.cylinder_height);
}

double largest_stable_phase(Integrator integrator, double damping_ratio) {
  const double z = damping_ratio;
  switch (integrator) {
    case Integrator::symplectic_euler:
      return 2.0 * (std::sqrt(1.0 + z * z) - z);
    case Integrator::velocity_verlet:
      return 2.0 * (std::sqrt(1.0 + 4.0 * z * z) - 2.0 * z);
    case Integrator::explicit_euler:
      return std::max(kElasticEuler, z > 1.0 ? 2.0 * (z - std::sqrt(z * z - 1.0)) : 2.0 * z);
  }
  return 0.0;
}

namespace {

/// largest_stable_phase for one contact and for many on a body, of the more damped kind of contact.
double phase_of(const Scene& scene, const LawParameters& law) {
  const Integrator integrator = scene.numerics.integrator;
  const double one = 0.5 * law.normal_damping, many = std::sqrt(kAutoContacts) * one;
  const double phase =
      std::min(largest_stable_phase(integrator, one), largest_stable_phase(integrator, many));
  // Plain Euler spends the damping of an oscillation: at its limit all of it, at half of that half.
  return integrator == Integrator::explicit_euler ? 0.5 * phase : phase;
}

}  // namespace

double automatic_time_step(const Scene& scene) {
  const Material& material = scene.particles.material;
  const ElasticSide side{material.shear_modulus * scene.numerics.stiffness_scale, material.poisson_ratio};
  const auto law = [&](const ContactParameters& contact) {
    return law_parameters(side, side, contact.restitution, 0.0, 0.0, 0.0, scene.contact.normal_damping,
                          TangentialHistory::force);
  };
  const LawParameters pair_law = law(scene.contact.particle_particle);
  const double Y_eff = pair_law.young;
  const double phase = std::min(phase_of(scene, pair_law), phase_of(scene, law(scene.contact.particle_wall)));
  const double v = fall_speed(scene.test);
  double step = std::numeric_limits<double>::infinity();
  for (const Clump& shape : scene.particles.shapes) {
    const double s = smallest_scale(scene.particles, shape);
    const double m = material.density * s * s * s * shape.volume;
    const double inertia = material.density * std::pow(s, 5) * shape.inertia.minCoeff();
    for (const Sphere& sphere : shape.spheres) {
      const double R_eff = 0.5 * s * sphere.radius, m_eff = 0.5 * m;
      const double overlap = std::pow(15.0 * m_eff * v * v / (16.0 * Y_eff * std::sqrt(R_eff)), 0.4);
      const double k = 2.0 * Y_eff * std::sqrt(R_eff * overlap);
      // The contact point lies on the sphere's surface; its farthest lever about the centre of mass bounds
      // the rotation. A single sphere is turned by the tangential force only, with the arm r and about the
      // same stiffness.
      const double arm = s * std::max(sphere.centre.norm(), sphere.radius);
      // Clumps that sink into each other touch with all the spheres of that part of their surfaces.
      const double others = static_cast<double>(shape.spheres.size() - 1);
      const double touching = 1.0 + others * overlap / (s * shape.equivalent_diameter());
      const double lambda = touching * k * 2.0 * (1.0 / m + arm * arm / inertia);
      step = std::min(step, phase / std::sqrt(lambda));
    }
  }
  return kAutoStepShare * step;
}

double time_step(const Scene& scene) {
  if (scene.numerics.time_step) return *scene.numerics.time_step;
  if (!scene.numerics.time_step_fraction) return automatic_time_step(scene);
  return *scene.numerics.time_step_fraction * rayleigh_time(smallest_sphere(scene.particles), scene);
}

}  // namespace repose
