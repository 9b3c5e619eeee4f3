#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "engine/base/random.hpp"
#include "engine/scene/heap_snapshot.hpp"

namespace repose {

/// A folder of the test's own, removed at its end.
class OutputTest : public ::testing::Test {
 protected:
  OutputTest()
      : folder_(std::filesystem::temp_directory_path() / ("repose-output-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~OutputTest() override { std::filesystem::remove_all(folder_); }
  OutputTest(const OutputTest&) = delete;
  OutputTest& operator=(const OutputTest&) = delete;

  std::filesystem::path folder_;
};

/// Bodies of one to three spheres that move and turn, on a base with both halves of a cylinder.
inline HeapSnapshot moving_snapshot() {
  RandomStream random(21, 0);
  const auto any = [&](double low, double high) {
    const double x = random.uniform(low, high);
    const double y = random.uniform(low, high);
    return Vec3(x, y, random.uniform(low, high));
  };
  HeapSnapshot heap;
  heap.time = 0.375;
  heap.base_radius = 0.0975;
  heap.base_height = 0.05;
  for (int b = 0; b < 9; ++b) {
    BodySnapshot body;
    body.position = any(0.01, 0.05);
    body.orientation = random.rotation();
    body.velocity = any(-1.0, 1.0);
    body.angular_velocity = any(-20.0, 20.0);
    body.mass = random.uniform(1e-4, 2e-4);
    body.volume = body.mass / 3886.0;
    body.shape = b % 2;
    body.scale = random.uniform(0.8, 1.2);
    heap.bodies.push_back(body);
    for (int s = 0; s <= b % 3; ++s) {
      heap.spheres.push_back({body.position + any(-0.002, 0.002), random.uniform(0.001, 0.003), b});
    }
  }
  heap.shells.push_back({0.05, 0.0, 0.3, 0.012, ShellSnapshot::Part::half_positive_x});
  heap.shells.push_back({0.05, 0.0, 0.3, -0.012, ShellSnapshot::Part::half_negative_x});
  return heap;
}

/// Velocity of a sphere's centre, v + ω × r, written out by components.
inline Vec3 velocity_of(const HeapSnapshot& heap, const SphereSnapshot& sphere) {
  const BodySnapshot& b = heap.bodies[static_cast<std::size_t>(sphere.body)];
  const Vec3 r = sphere.centre - b.position;
  const Vec3& w = b.angular_velocity;
  return {b.velocity.x() + w.y() * r.z() - w.z() * r.y(), b.velocity.y() + w.z() * r.x() - w.x() * r.z(),
          b.velocity.z() + w.x() * r.y() - w.y() * r.x()};
}

}  // namespace repose
