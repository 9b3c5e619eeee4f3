#include "engine/output/vtp_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <numeric>
#include <stdexcept>

namespace repose {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say byte_order=\"LittleEndian\"");

/// Base64 of a 64-bit length in bytes followed by the bytes (RFC 4648).
std::string encoded(const void* data, std::size_t bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> raw(8 + bytes);
  const std::uint64_t length = bytes;
  std::memcpy(raw.data(), &length, 8);
  if (bytes > 0) std::memcpy(raw.data() + 8, data, bytes);
  std::string text;
  text.reserve((raw.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < raw.size(); k += 3) {
    const unsigned b0 = raw[k], b1 = k + 1 < raw.size() ? raw[k + 1] : 0U,
                   b2 = k + 2 < raw.size() ? raw[k + 2] : 0U;
    const unsigned word = b0 << 16 | b1 << 8 | b2;
    text += kLetters[word >> 18 & 63U];
    text += kLetters[word >> 12 & 63U];
    text += k + 1 < raw.size() ? kLetters[word >> 6 & 63U] : '=';
    text += k + 2 < raw.size() ? kLetters[word & 63U] : '=';
  }
  return text;
}

/// One DataArray of doubles or 32-bit integers.
template <class Number>
std::string data_array(const std::string& name, int components, const std::vector<Number>& numbers) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
      sizeof(Number) == 8 ? "Float64" : "Int32", name, components,
      encoded(numbers.data(), numbers.size() * sizeof(Number)));
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
  return numbers;
}

std::string cells(const std::vector<std::int32_t>& connectivity, const std::vector<std::int32_t>& offsets) {
  return data_array("connectivity", 1, connectivity) + data_array("offsets", 1, offsets);
}

}  // namespace

VtpFile::VtpFile(const std::vector<Vec3>& points)
    : point_count_(points.size()), points_(data_array("Points", 3, flat(points))) {
  std::vector<std::int32_t> numbers(points.size()), ends(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::iota(ends.begin(), ends.end(), 1);
  cells_ = cells(numbers, ends);
}

void VtpFile::add(const std::string& name, const std::vector<double>& values) {
  point_data_ += data_array(name, 1, values);
}
void VtpFile::add(const std::string& name, const std::vector<std::int32_t>& values) {
  point_data_ += data_array(name, 1, values);
}
void VtpFile::add(const std::string& name, const std::vector<Vec3>& values) {
  point_data_ += data_array(name, 3, flat(values));
}
void VtpFile::add(const std::string& name, const std::vector<std::array<double, 4>>& values) {
  std::vector<double> numbers;
  for (const auto& value : values) numbers.insert(numbers.end(), value.begin(), value.end());
  point_data_ += data_array(name, 4, numbers);
}

void VtpFile::set_polygons(const std::vector<std::vector<std::int32_t>>& polygons) {
  std::vector<std::int32_t> connectivity, ends;
  for (const auto& polygon : polygons) {
    connectivity.insert(connectivity.end(), polygon.begin(), polygon.end());
    ends.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  cells_ = cells(connectivity, ends);
  polygons_ = polygons.size();
}

void VtpFile::write(const std::filesystem::path& file) const {
  const std::size_t vertices = polygons_ > 0 ? 0 : point_count_;
  const char* kind = polygons_ > 0 ? "Polys" : "Verts";
  write_whole(
      file,
      fmt::format(
          "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
          "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
          "NumberOfStrips=\"0\" "
          "NumberOfPolys=\"{}\">\n<Points>\n{}</Points>\n<PointData>\n{}</PointData>\n<{}>\n{}</{}>\n"
          "</Piece>\n</PolyData>\n</VTKFile>\n",
          point_count_, vertices, polygons_, points_, point_data_, kind, cells_, kind));
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path part = file;
  part += ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(part, file, error);
  if (!stream || error) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace repose
