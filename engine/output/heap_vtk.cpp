#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/output/heap_files.hpp"
#include "engine/output/vtp_file.hpp"
#include "engine/output/wall_polygons.hpp"

namespace repose {

namespace {

constexpr const char* kKinds[] = {"spheres", "bodies", "walls"};

/// Text as it stands between the quotes of an XML attribute.
std::string attribute(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

VtpFile sphere_file(const HeapSnapshot& heap) {
  std::vector<Vec3> centres, velocities;
  std::vector<double> radii, diameters, speeds;
  std::vector<std::int32_t> bodies, shapes;
  for (const SphereSnapshot& sphere : heap.spheres) {
    const BodySnapshot& body = heap.bodies[static_cast<std::size_t>(sphere.body)];
    const Vec3 velocity = body.velocity + body.angular_velocity.cross(sphere.centre - body.position);
    centres.push_back(sphere.centre);
    radii.push_back(sphere.radius);
    diameters.push_back(2.0 * sphere.radius);
    velocities.push_back(velocity);
    speeds.push_back(velocity.norm());
    bodies.push_back(sphere.body);
    shapes.push_back(body.shape);
  }
  VtpFile file(centres);
  file.add("radius", radii);
  file.add("diameter", diameters);
  file.add("body", bodies);
  file.add("shape", shapes);
  file.add("velocity", velocities);
  file.add("speed", speeds);
  return file;
}

VtpFile body_file(const HeapSnapshot& heap) {
  std::vector<Vec3> positions, velocities, angular_velocities;
  std::vector<std::array<double, 4>> orientations;
  std::vector<double> masses, volumes, scales, energies;
  std::vector<std::int32_t> shapes;
  for (const BodySnapshot& body : heap.bodies) {
    positions.push_back(body.position);
    velocities.push_back(body.velocity);
    angular_velocities.push_back(body.angular_velocity);
    orientations.push_back(
        {body.orientation.w(), body.orientation.x(), body.orientation.y(), body.orientation.z()});
    masses.push_back(body.mass);
    volumes.push_back(body.volume);
    scales.push_back(body.scale);
    energies.push_back(0.5 * body.mass * body.velocity.squaredNorm());
    shapes.push_back(body.shape);
  }
  VtpFile file(positions);
  file.add("orientation", orientations);
  file.add("mass", masses);
  file.add("volume", volumes);
  file.add("scale", scales);
  file.add("shape", shapes);
  file.add("velocity", velocities);
  file.add("angular_velocity", angular_velocities);
  file.add("translational_energy", energies);
  return file;
}

VtpFile wall_file(const HeapSnapshot& heap) {
  const WallPolygons walls = wall_polygons(heap);
  VtpFile file(walls.points);
  file.add("wall", walls.wall);
  file.set_polygons(walls.polygons);
  return file;
}

}  // namespace

std::vector<std::filesystem::path> write_vtk(const HeapSnapshot& heap, const std::filesystem::path& folder,
                                             const std::string& name) {
  const VtpFile files[] = {sphere_file(heap), body_file(heap), wall_file(heap)};
  std::vector<std::filesystem::path> written;
  for (std::size_t k = 0; k < std::size(files); ++k) {
    written.push_back(folder / fmt::format("{}_{}.vtp", name, kKinds[k]));
    files[k].write(written.back());
  }
  return written;
}

FrameSeries::FrameSeries(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {
  std::filesystem::create_directories(folder_ / (name_ + "_frames"));
}

void FrameSeries::add(const HeapSnapshot& heap) {
  frames_.push_back(
      {heap.time, write_vtk(heap, folder_ / (name_ + "_frames"), fmt::format("{:05}", next_++))});
  write_collections();
}

void FrameSeries::retain(const std::vector<char>& keep) {
  std::vector<Frame> kept, dropped;
  for (std::size_t k = 0; k < frames_.size(); ++k) (keep[k] ? kept : dropped).push_back(frames_[k]);
  frames_ = std::move(kept);
  write_collections();  // before the files go: no collection ever names a file that is not there
  for (const Frame& frame : dropped)
    for (const auto& file : frame.files) std::filesystem::remove(file);
}

void FrameSeries::write_collections() const {
  for (std::size_t k = 0; k < std::size(kKinds); ++k) {
    std::string entries;
    for (const Frame& frame : frames_)
      entries += fmt::format("<DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}_frames/{}\"/>\n", frame.time,
                             attribute(name_), attribute(frame.files[k].filename().string()));
    write_whole(
        folder_ / fmt::format("{}_{}.pvd", name_, kKinds[k]),
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n" +
            entries + "</Collection>\n</VTKFile>\n");
  }
}

}  // namespace repose
