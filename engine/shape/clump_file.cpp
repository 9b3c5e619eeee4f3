#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/input_error.hpp"
#include "engine/shape/clump.hpp"
#include "engine/shape/clump_export.hpp"

namespace repose {

namespace {

using Json = nlohmann::ordered_json;

Json parsed(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError({file.string(), "", "", "cannot be opened"});
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError({file.string(), fmt::format("byte {}", error.byte), "", "is not JSON"});
  } catch (const Json::out_of_range&) {
    throw InputError({file.string(), "", "", "holds a number that is too large"});
  }
}

/// Reads one clump file; every fault is collected, and what could not be read stays at zero.
class ClumpReader {
 public:
  explicit ClumpReader(const std::filesystem::path& file) : file_(file.string()), json_(parsed(file)) {}

  Clump read() {
    if (!json_.is_object()) throw InputError({file_, "", json_.type_name(), "must be an object"});
    known_keys(json_, "",
               {"schema", "name", "made_by", "density_kg_m3", "mass", "inertia", "volume_error", "eit_error",
                "spheres"});
    if (json_.contains("schema") && json_["schema"] != 1) fault("/schema", json_["schema"], "must be 1");
    Clump clump;
    clump.name = name();
    read_spheres(clump);
    const std::size_t faults_of_spheres = faults_.list().size();
    const double density = json_.contains("density_kg_m3") ? positive(json_, "density_kg_m3", "") : 1.0;
    clump.volume = positive(json_, "mass", "") / density;
    clump.inertia = moments() / density;
    if (faults_.list().size() == faults_of_spheres) check_size(clump);
    faults_.throw_if_any();
    return clump;
  }

 private:
  void fault(const std::string& pointer, const Json& value, const std::string& rule) {
    faults_.add(file_, pointer, value.dump(), rule);
  }

  void known_keys(const Json& object, const std::string& pointer, const std::set<std::string>& known) {
    for (const auto& [key, value] : object.items())
      if (!known.contains(key))
        fault(fmt::format("{}/{}", pointer, key), value, "is not a key of a clump file");
  }

  std::string name() {
    if (!json_.contains("name")) return std::filesystem::path(file_).stem().string();
    if (json_["name"].is_string()) return json_["name"].get<std::string>();
    fault("/name", json_["name"], "must be a text");
    return {};
  }

  /// A finite number, or NaN with a fault.
  double number(const Json& object, const std::string& key, const std::string& pointer) {
    const std::string where = pointer + "/" + key;
    if (!object.contains(key)) {
      faults_.add(file_, where, "", "is missing");
    } else if (!object[key].is_number() || !std::isfinite(object[key].get<double>())) {
      fault(where, object[key], "must be a number");
    } else {
      return object[key].get<double>();
    }
    return std::nan("");
  }

  double positive(const Json& object, const std::string& key, const std::string& pointer) {
    const double value = number(object, key, pointer);
    if (value <= 0.0) fault(pointer + "/" + key, object[key], "must be > 0");
    return value;
  }

  void read_spheres(Clump& clump) {
    if (!json_.contains("spheres") || !json_["spheres"].is_array() || json_["spheres"].empty()) {
      faults_.add(file_, "/spheres", "", "must be a list of at least one sphere");
      return;
    }
    for (std::size_t i = 0; i < json_["spheres"].size(); ++i) {
      const Json& item = json_["spheres"][i];
      const std::string pointer = fmt::format("/spheres/{}", i);
      if (!item.is_object()) {
        fault(pointer, item, "must be an object with x, y, z and r");
        continue;
      }
      known_keys(item, pointer, {"x", "y", "z", "r", "inner"});
      const Vec3 centre(number(item, "x", pointer), number(item, "y", pointer), number(item, "z", pointer));
      const double radius = positive(item, "r", pointer);
      const bool marked = item.contains("inner");
      if (marked && !item["inner"].is_boolean())
        fault(pointer + "/inner", item["inner"], "must be true or false");
      if (!marked || item["inner"] != true) clump.spheres.push_back({centre, radius});
    }
    if (clump.spheres.empty()) faults_.add(file_, "/spheres", "", "must hold a sphere that is not inner");
  }

  Vec3 moments() {
    Vec3 moments = Vec3::Constant(std::nan(""));
    if (!json_.contains("inertia") || !json_["inertia"].is_array() || json_["inertia"].size() != 3) {
      faults_.add(file_, "/inertia", "", "must be a list of three principal moments");
      return moments;
    }
    const Json& list = json_["inertia"];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string pointer = fmt::format("/inertia/{}", k);
      if (!list[k].is_number() || !(list[k].get<double>() > 0.0))
        fault(pointer, list[k], "must be a number > 0");
      else
        moments[static_cast<Eigen::Index>(k)] = list[k].get<double>();
    }
    // I_x + I_y − I_z = 2 ∫ z² dm ≥ 0; a sum that rounding has moved passes.
    const double largest = moments.maxCoeff();
    if (moments.allFinite() && moments.sum() - 2.0 * largest < -1e-9 * largest)
      fault("/inertia", list, "no moment may exceed the sum of the other two");
    return moments;
  }

  /// A unit mixed up (millimetres, a mass for another density) moves the volume by orders of magnitude: the
  /// body must fit into the sphere around it, and cannot be smaller than a hundredth of its largest sphere.
  void check_size(const Clump& clump) {
    double largest = 0.0;
    for (const Sphere& sphere : clump.spheres) largest = std::max(largest, sphere.radius);
    const auto ball = [](double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; };
    if (clump.volume > 2.0 * ball(clump.bounding_radius()) || clump.volume < 0.01 * ball(largest))
      fault("/mass", json_["mass"],
            "does not fit the size of the spheres: lengths are in m, mass is density × volume");
    // Each moment is ∫ (distance from an axis)² dV: that of a body that lies within the sphere around it and
    // fills some of its largest sphere.
    const double reach = clump.bounding_radius();
    if (clump.inertia.maxCoeff() > 2.0 * clump.volume * reach * reach ||
        clump.inertia.minCoeff() < 0.01 * 0.4 * ball(largest) * largest * largest)
      fault("/inertia", json_["inertia"],
            "does not fit the size of the spheres: lengths are in m, moments are density × ∫ r² dV");
  }

  std::string file_;
  Json json_;
  Faults faults_;
};

Json sphere_json(const Sphere& sphere, bool inner) {
  Json item = {
      {"x", sphere.centre.x()}, {"y", sphere.centre.y()}, {"z", sphere.centre.z()}, {"r", sphere.radius}};
  if (inner) item["inner"] = true;
  return item;
}

}  // namespace

Clump read_clump(const std::filesystem::path& file) { return ClumpReader(file).read(); }

std::string clump_text(const Clump& clump, const ClumpFileExtras& extras) {
  Json json = {{"schema", 1}, {"name", clump.name}};
  if (!extras.made_by.empty()) json["made_by"] = extras.made_by;
  json["density_kg_m3"] = extras.density;
  json["mass"] = extras.density * clump.volume;
  const Vec3 moments = extras.density * clump.inertia;
  json["inertia"] = {moments.x(), moments.y(), moments.z()};
  if (extras.volume_error) json["volume_error"] = *extras.volume_error;
  if (extras.eit_error) json["eit_error"] = *extras.eit_error;

  // One sphere a line: the file stays short enough to read and to compare.
  std::string text = json.dump(2);
  text.erase(text.rfind('\n'));
  text += ",\n  \"spheres\": [";
  const char* separator = "\n    ";
  const auto add = [&](const Sphere& sphere, bool inner) {
    text += separator + sphere_json(sphere, inner).dump();
    separator = ",\n    ";
  };
  for (const Sphere& sphere : clump.spheres) add(sphere, false);
  for (const Sphere& sphere : extras.inner) add(sphere, true);
  return text + "\n  ]\n}\n";
}

void write_clump(const std::filesystem::path& file, const Clump& clump, const ClumpFileExtras& extras) {
  write_text(file, clump_text(clump, extras));
}

}  // namespace repose
