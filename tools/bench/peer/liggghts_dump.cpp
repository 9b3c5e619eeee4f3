#include "tools/bench/peer/liggghts_dump.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/base/input_error.hpp"

namespace repose::peer {

namespace {

struct DumpedSphere {
  long id = 0;
  long body = -1;
  Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero(), w = Vec3::Zero();
  double radius = 0.0;
};

/// Where each column that is read stands; −1: it is not there.
class Columns {
 public:
  Columns(const std::string& header, const std::string& file) : file_(file) {
    std::istringstream words(header);
    for (std::string word; words >> word;) names_.push_back(word);
  }
  [[nodiscard]] int find(const char* name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
  }
  [[nodiscard]] int need(const char* name) const {
    const int column = find(name);
    if (column < 0) throw InputError({file_, "ITEM: ATOMS", "", fmt::format("has no column {}", name)});
    return column;
  }
  [[nodiscard]] std::size_t count() const { return names_.size(); }

 private:
  std::string file_;
  std::vector<std::string> names_;
};

std::vector<DumpedSphere> read_atoms(std::istream& stream, std::size_t count, const Columns& columns,
                                     const std::string& file) {
  const std::array<int, 3> x{columns.need("x"), columns.need("y"), columns.need("z")};
  const std::array<int, 3> v{columns.find("vx"), columns.find("vy"), columns.find("vz")};
  const std::array<int, 3> w{columns.find("omegax"), columns.find("omegay"), columns.find("omegaz")};
  const int id = columns.need("id"), radius = columns.need("radius"), body = columns.find("id_multisphere");
  std::vector<double> values(columns.count());
  const auto vector_at = [&values](const std::array<int, 3>& at) {
    Vec3 vector = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (at[static_cast<std::size_t>(k)] >= 0)
        vector[k] = values[static_cast<std::size_t>(at[static_cast<std::size_t>(k)])];
    return vector;
  };
  std::vector<DumpedSphere> spheres(count);
  for (DumpedSphere& sphere : spheres) {
    for (double& value : values)
      if (!(stream >> value))
        throw InputError({file, "ITEM: ATOMS", "", "ends early or holds what is no number"});
    sphere.id = std::lround(values[static_cast<std::size_t>(id)]);
    sphere.body = body < 0 ? -1 : std::lround(values[static_cast<std::size_t>(body)]);
    sphere.radius = values[static_cast<std::size_t>(radius)];
    sphere.centre = vector_at(x);
    sphere.velocity = vector_at(v);
    sphere.w = vector_at(w);
  }
  return spheres;
}

/// The last frame, and the time step that it carries.
std::vector<DumpedSphere> read_frame(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<DumpedSphere> spheres;
  bool found = false;
  std::size_t count = 0;
  const std::string head = "ITEM: ATOMS ";
  for (std::string line; std::getline(stream, line);) {
    if (line == "ITEM: NUMBER OF ATOMS")
      stream >> count;
    else if (line.starts_with(head)) {
      spheres = read_atoms(stream, count, Columns(line.substr(head.size()), file.string()), file.string());
      found = true;
    }
  }
  if (!found) throw InputError({file.string(), "", "", "is missing or holds no frame"});
  std::sort(spheres.begin(), spheres.end(),
            [](const DumpedSphere& a, const DumpedSphere& b) { return a.id < b.id; });
  return spheres;
}

bool same_radii(const Clump& clump, const std::vector<DumpedSphere>& spheres) {
  return std::equal(
      clump.spheres.begin(), clump.spheres.end(), spheres.begin(), spheres.end(),
      [](const Sphere& a, const DumpedSphere& b) { return std::abs(a.radius - b.radius) < 1e-6 * a.radius; });
}

/// Places a kind of particle where the spheres of a dump are; false if they do not lie as its own do.
bool place(const Template& kind, const std::vector<DumpedSphere>& spheres, BodySnapshot& body) {
  const auto count = static_cast<Eigen::Index>(spheres.size());
  Eigen::Matrix3Xd local(3, count), world(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    local.col(k) = kind.clump.spheres[static_cast<std::size_t>(k)].centre;
    world.col(k) = spheres[static_cast<std::size_t>(k)].centre;
  }
  const Eigen::Matrix4d motion =
      count == 1
          ? Eigen::Matrix4d(
                (Eigen::Translation3d(world.col(0) - local.col(0)) * Eigen::Affine3d::Identity()).matrix())
          : Eigen::Matrix4d(Eigen::umeyama(local, world, false));
  const Mat3 turn = motion.topLeftCorner<3, 3>();
  body.position = motion.topRightCorner<3, 1>();
  body.orientation = Quat(turn);
  body.angular_velocity = spheres.front().w;
  body.velocity =
      spheres.front().velocity - body.angular_velocity.cross(spheres.front().centre - body.position);
  body.mass = kind.mass;
  body.volume = kind.volume;
  body.shape = kind.shape;
  body.scale = kind.scale;
  const double error = ((turn * local).colwise() + body.position - world).colwise().norm().maxCoeff();
  return error < 1e-3 * kind.clump.bounding_radius();
}

}  // namespace

HeapSnapshot read_liggghts_dump(const std::filesystem::path& file, const std::vector<Template>& kinds,
                                const SlumpTest& test) {
  std::map<long, std::vector<DumpedSphere>> bodies;
  long single = -1;  // spheres without a body count downwards
  for (const DumpedSphere& sphere : read_frame(file))
    bodies[sphere.body < 0 ? single-- : sphere.body].push_back(sphere);

  HeapSnapshot heap;
  heap.base_radius = test.base_radius;
  heap.base_height = test.base_height;
  for (const auto& [id, spheres] : bodies) {
    BodySnapshot body;
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&spheres = spheres, &body](const Template& candidate) {
          return same_radii(candidate.clump, spheres) && place(candidate, spheres, body);
        });
    if (kind == kinds.end())
      throw InputError({file.string(), fmt::format("body {}", id), fmt::format("{} spheres", spheres.size()),
                        "is no particle of the case"});
    if (body.position.z() + kind->clump.bounding_radius() < 0.0) continue;
    for (const DumpedSphere& sphere : spheres)
      heap.spheres.push_back({sphere.centre, sphere.radius, static_cast<int>(heap.bodies.size())});
    heap.bodies.push_back(body);
  }
  return heap;
}

double energy_ratio(const HeapSnapshot& heap, const std::vector<Template>& kinds, double density) {
  double energy = 0.0, weight = 0.0;
  for (const BodySnapshot& body : heap.bodies) {
    if (std::hypot(body.position.x(), body.position.y()) > heap.base_radius) continue;
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&body](const Template& candidate) {
      return candidate.shape == body.shape && candidate.scale == body.scale;
    });
    const Vec3 w = body.orientation.conjugate() * body.angular_velocity;
    energy += 0.5 * body.mass * body.velocity.squaredNorm() +
              0.5 * density * w.cwiseProduct(kind->clump.inertia).dot(w);
    weight += body.mass * kGravity * std::cbrt(6.0 * body.volume / kPi);
  }
  return weight > 0.0 ? energy / weight : 0.0;
}

}  // namespace repose::peer
