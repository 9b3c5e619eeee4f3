#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "unit/output/xml_reader.hpp"

namespace repose {

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// RFC 4648, the other way round from the writer: letter by letter through a table of 256.
inline std::vector<unsigned char> base64_decoded(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t value = letters.find(c);
    if (value == std::string::npos) throw std::runtime_error("not base64");
    buffer = buffer << 6 | static_cast<unsigned>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(buffer >> bits & 0xffU));
  }
  return bytes;
}

struct VtpArray {
  int components = 1;
  std::vector<double> values;
  [[nodiscard]] std::size_t tuples() const { return values.size() / static_cast<std::size_t>(components); }
};

/// A .vtp file as its own format demands it, read without the writer's code.
struct VtpContent {
  std::map<std::string, std::string> piece;  ///< attributes NumberOf…
  VtpArray points;
  std::map<std::string, VtpArray> data;
  std::vector<std::vector<int>> cells;
};

inline VtpArray read_array(const XmlElement& e) {
  if (e.attributes.at("format") != "binary") throw std::runtime_error("format");
  const std::vector<unsigned char> bytes = base64_decoded(e.text);
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), 8);
  if (length + 8 != bytes.size()) throw std::runtime_error("length of " + e.attributes.at("Name"));
  VtpArray array;
  array.components = std::stoi(e.attributes.at("NumberOfComponents"));
  const auto read = [&](auto number) {
    for (std::size_t at = 8; at < bytes.size(); at += sizeof(number)) {
      std::memcpy(&number, bytes.data() + at, sizeof(number));
      array.values.push_back(static_cast<double>(number));
    }
  };
  if (e.attributes.at("type") == "Float64") {
    read(double{});
  } else if (e.attributes.at("type") == "Int32") {
    read(std::int32_t{});
  } else {
    throw std::runtime_error("type " + e.attributes.at("type"));
  }
  return array;
}

inline VtpContent read_vtp(const std::filesystem::path& file) {
  const XmlElement root = XmlReader(read_text(file)).document();
  if (root.name != "VTKFile" || root.attributes.at("type") != "PolyData" ||
      root.attributes.at("header_type") != "UInt64" || root.attributes.at("byte_order") != "LittleEndian") {
    throw std::runtime_error("header of " + file.string());
  }
  const XmlElement& piece = root.child("PolyData").child("Piece");
  VtpContent content;
  content.piece = piece.attributes;
  content.points = read_array(piece.child("Points").child("DataArray"));
  for (const XmlElement& e : piece.child("PointData").children) {
    content.data[e.attributes.at("Name")] = read_array(e);
  }
  const bool polygons = content.piece.at("NumberOfPolys") != "0";
  const XmlElement& cells = piece.child(polygons ? "Polys" : "Verts");
  std::map<std::string, VtpArray> lists;
  for (const XmlElement& e : cells.children) lists[e.attributes.at("Name")] = read_array(e);
  std::size_t begin = 0;
  for (const double end : lists.at("offsets").values) {
    content.cells.emplace_back();
    for (; begin < static_cast<std::size_t>(end); ++begin) {
      content.cells.back().push_back(static_cast<int>(lists.at("connectivity").values.at(begin)));
    }
  }
  return content;
}

}  // namespace repose
