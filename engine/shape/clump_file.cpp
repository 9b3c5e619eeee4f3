#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/input_error.hpp"
#include "engine/base/json_file.hpp"
#include "engine/shape/clump.hpp"
#include "engine/shape/clump_export.hpp"
#include "engine/shape/clump_mass.hpp"

namespace repose {

namespace {

using Json = nlohmann::ordered_json;

/// Reads one clump file; every fault is collected, and what could not be read stays at zero.
class ClumpReader {
 public:
  explicit ClumpReader(const std::filesystem::path& file) : file_(file.string()), json_(read_json(file)) {}

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
    if (faults_.list().size() == faults_of_spheres) check_mass(clump);
    check_twins(clump);
    faults_.throw_if_any();
    return clump;
  }

 private:
  void fault(const std::string& pointer, const Json& value, const std::string& rule) {
    faults_.add(file_, pointer, shown(value), rule);
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
      if (marked && item["inner"] == true) continue;
      clump.spheres.push_back({centre, radius});
      places_.push_back(i);
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

  void check_mass(const Clump& clump) {
    for (const MassFault& found : mass_faults(clump)) fault("/" + found.key, json_[found.key], found.rule);
  }

  /// Two spheres in one place are a slip of the list; the second would double every force of the first.
  void check_twins(const Clump& clump) {
    for (std::size_t i = 0; i < clump.spheres.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (clump.spheres[i] == clump.spheres[j]) {
          fault(fmt::format("/spheres/{}", places_[i]), json_["spheres"][places_[i]],
                fmt::format("is the same as sphere {}", places_[j]));
          break;
        }
  }

  std::string file_;
  Json json_;
  std::vector<std::size_t> places_;  ///< in the file, of every sphere that is carried
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
