// What a body costs in a step, and a contact in its kernel, by the number of bodies: a settled column of a
// case's particles, ten or so deep and as wide as it takes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>

#include "engine/base/input_error.hpp"
#include "engine/base/random.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/dynamics/time_step.hpp"
#include "engine/scene/scene_reader.hpp"
#include "engine/slump/curve_order.hpp"

namespace {

using namespace repose;

constexpr int kLayers = 10;
constexpr double kSettling = 0.25;  ///< simulated [s]: the fall through half a column and its rest
constexpr int kBatches = 7, kSteps = 100;

/// Wall seconds of one batch, the median of kBatches.
template <class Batch>
double median_seconds(Batch batch) {
  std::vector<double> seconds;
  for (int k = 0; k < kBatches; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    batch();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::ranges::sort(seconds);
  return seconds[kBatches / 2];
}

/// `count` bodies on a cubic lattice, turned at random, in a cylinder that is just wide enough for kLayers.
void fill(Simulation& simulation, const Scene& scene, std::size_t count) {
  double reach = 0.0;
  for (const Clump& shape : scene.particles.shapes) reach = std::max(reach, shape.bounding_radius());
  const double edge = 2.05 * reach;
  std::vector<Vec3> layer, places;
  double radius = 0.0;
  for (int ring = 1; layer.size() * kLayers < count; ++ring) {
    layer.clear();
    radius = ring * edge;
    for (int x = -ring; x <= ring; ++x)
      for (int y = -ring; y <= ring; ++y)
        if (edge * std::hypot(x, y) + reach < radius) layer.push_back({edge * x, edge * y, 0.0});
  }
  for (int z = 0; places.size() < count; ++z)
    for (const Vec3& place : layer)
      if (places.size() < count) places.push_back(place + Vec3(0.0, 0.0, edge * (z + 0.6)));
  Wall base, cylinder;
  cylinder.kind = Wall::Kind::closed_shell;
  cylinder.radius = radius;
  cylinder.z_high = 1.0;
  simulation.walls = {base, cylinder};
  RandomStream random(1, 1);
  for (const std::size_t k : curve_order(places, edge)) {
    NewBody body;
    body.shape = static_cast<int>(k % scene.particles.shapes.size());
    body.position = places[k];
    body.orientation = random.rotation();
    body.velocity = 0.3 * Vec3(random.normal(), random.normal(), random.normal());
    simulation.add(body);
  }
}

/// Seconds of the pair kernel over all contacts, on a copy of what it reads and writes.
double kernel_seconds(const Simulation& simulation, RollingModel model, Arithmetic arithmetic) {
  Bodies bodies = simulation.bodies();
  const RecordVector<PlacedSphere> placed = simulation.contacts().placed;
  std::vector<NearList> near;
  for (const Section& section : simulation.contacts().sections) near.push_back(section.near_pairs);
  const ForceKernels kernels = force_kernels(model, arithmetic);
  TouchingList touching;
  LoadsBeyond beyond;
  beyond.start(0);
  const auto pass = [&] {
    for (NearList& list : near) kernels.pairs(simulation.laws(), bodies, placed, list, touching, beyond);
  };
  // As many passes as make a batch of some milliseconds.
  const int passes = static_cast<int>(std::max<std::size_t>(4, 200000 / (bodies.count + 1)));
  return median_seconds([&] {
           for (int k = 0; k < passes; ++k) pass();
         }) /
         passes;
}

void measure(const Scene& scene, std::size_t count, int threads) {
  const double dt = time_step(scene);
  const auto crew = std::make_shared<Crew>(threads - 1);
  Simulation simulation(scene, dt, crew);
  fill(simulation, scene, count);
  for (int step = 0; step < static_cast<int>(kSettling / dt); ++step)
    if (!simulation.step()) throw std::runtime_error("the motion has diverged: use a smaller step");
  const long looks = simulation.contacts().looks();
  const double step_seconds = median_seconds([&] {
                                for (int k = 0; k < kSteps; ++k) (void)simulation.step();
                              }) /
                              kSteps;
  std::size_t contacts = 0, near = 0;
  for (const Section& section : simulation.contacts().sections) near += section.near_pairs.count;
  simulation.contacts().for_each_pair([&](const NearList&, std::size_t) { ++contacts; });
  const auto bodies = static_cast<double>(count), touching = static_cast<double>(contacts);
  fmt::print("{:>7} {:>10.1f} {:>12.1f} {:>10.2f} {:>8.2f} {:>15.3f}\n", count, 1e9 * step_seconds / bodies,
             1e9 * kernel_seconds(simulation, scene.contact.rolling_model, scene.numerics.arithmetic) /
                 std::max(touching, 1.0),
             touching / bodies, static_cast<double>(near) / bodies,
             static_cast<double>(simulation.contacts().looks() - looks) / (kBatches * kSteps));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What a body costs in a step, and a contact in its kernel, by the number of bodies");
  std::string case_file;
  std::vector<std::string> assignments;
  std::vector<std::size_t> counts{32, 500, 2000, 8000, 50000};
  int threads = 1;
  app.add_option("CASE", case_file, "Whose particles, laws and step are taken")->required();
  app.add_option("--set", assignments, "KEY=VALUE …, as of repose simulate");
  app.add_option("--bodies", counts, "Numbers of bodies");
  app.add_option("--threads", threads, "Of the run")->check(CLI::Range(1, Crew::kMostMembers));
  CLI11_PARSE(app, argc, argv);
  try {
    CaseDocument document = CaseDocument::load(case_file);
    Faults faults;
    for (const std::string& assignment : assignments) document.set_from_command_line(assignment, faults);
    const Scene scene = read_scene(document, faults);
    faults.throw_if_any();
    fmt::print("{:>7} {:>10} {:>12} {:>10} {:>8} {:>15}\n", "bodies", "ns a body", "ns a contact", "contacts",
               "near", "looks a step");
    fmt::print("{:>7} {:>10} {:>12} {:>10} {:>8} {:>15}\n", "", "and step", "in kernel", "a body", "a body",
               "");
    for (const std::size_t count : counts) measure(scene, count, threads);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
