#include "sweep/flanks_json.hpp"

#include <limits>
#include <nlohmann/json.hpp>

namespace repose::sweep {

namespace {

using nlohmann::json;

double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

}  // namespace

std::string flanks_to_json(const Flanks& flanks) {
  json list = json::array();
  for (const Flank& flank : flanks) {
    json profile = json::array();
    for (const ProfilePoint& point : flank.profile) profile.push_back({point.r, point.z});
    list.push_back({{"angle", flank.angle},
                    {"standard_error", flank.standard_error},
                    {"z0", flank.z0},
                    {"r_begin", flank.r_begin},
                    {"r_end", flank.r_end},
                    {"profile", std::move(profile)}});
  }
  return list.dump();
}

Flanks flanks_from_json(const std::string& text) {
  const json list = json::parse(text);
  Flanks flanks;
  for (std::size_t i = 0; i < flanks.size(); ++i) {
    const json& from = list.at(i);
    Flank& flank = flanks[i];
    flank.angle = number(from.at("angle"));
    flank.standard_error = number(from.at("standard_error"));
    flank.z0 = number(from.at("z0"));
    flank.r_begin = number(from.at("r_begin"));
    flank.r_end = number(from.at("r_end"));
    for (const json& point : from.at("profile"))
      flank.profile.push_back({number(point.at(0)), number(point.at(1))});
  }
  return flanks;
}

}  // namespace repose::sweep
