#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/vec3.hpp"

namespace repose {

/// A VTK PolyData file (.vtp, XML, version 1.0): points with data, and either one vertex per point or
/// polygons. Arrays are stored inline as base64 of little-endian numbers with a 64-bit length, so that the
/// file is compact and still XML. Source: VTK file formats, chapter "XML File Formats".
class VtpFile {
 public:
  /// @param points  [m]; every array added later has one entry per point
  explicit VtpFile(const std::vector<Vec3>& points);

  void add(const std::string& name, const std::vector<double>& values);
  void add(const std::string& name, const std::vector<std::int32_t>& values);
  void add(const std::string& name, const std::vector<Vec3>& values);
  void add(const std::string& name, const std::vector<std::array<double, 4>>& values);
  /// Polygons instead of vertices: each a list of point numbers.
  void set_polygons(const std::vector<std::vector<std::int32_t>>& polygons);

  /// Writes the file whole under another name and then renames it. Throws std::runtime_error naming the file
  /// if that fails.
  void write(const std::filesystem::path& file) const;

 private:
  std::size_t point_count_;
  std::string points_;
  std::string point_data_;
  std::string cells_;
  std::size_t polygons_ = 0;
};

/// Writes a text file whole under another name and renames it, so that no reader ever sees half of it.
/// Throws std::runtime_error naming the file.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace repose
