#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <sstream>

#include "engine/shape/mesh_formats.hpp"

namespace repose {

namespace {

struct Property {
  std::string name;
  bool list = false;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties = {};

  [[nodiscard]] bool has(const std::string& property, bool list) const {
    return std::any_of(properties.begin(), properties.end(),
                       [&](const Property& own) { return own.name == property && own.list == list; });
  }
};

template <class Whole>
std::optional<Whole> whole_number(const std::string& word) {
  Whole number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

bool is_corner_list(const Property& property) {
  return property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

class PlyReader {
 public:
  PlyReader(const std::string& text, std::string file, Faults& faults)
      : file_(std::move(file)), faults_(faults), rows_(faults, file_, "rows"), lines_(unix_lines(text)) {}

  RawMesh read() {
    read_header();
    if (!faults_.empty()) return std::move(mesh_);
    for (const Element& element : elements_)
      for (std::size_t row = 0; row < element.count; ++row)
        if (!read_row(element, row)) return std::move(mesh_);
    if (next_line(true))
      rows_.add(fmt::format("line {}", line_number_), "",
                "the header announces no more rows than those before");
    for (const auto& [corners, place] : polygons_) add_polygon(mesh_, corners, place, 0, rows_);
    return std::move(mesh_);
  }

 private:
  struct Polygon {
    std::vector<long> corners;
    FacetPlace place;
  };

  bool next_line(bool skip_blank) {
    while (std::getline(lines_, line_)) {
      ++line_number_;
      if (!skip_blank || line_.find_first_not_of(" \t") != std::string::npos) return true;
    }
    return false;
  }

  void header_fault(const std::string& value, const std::string& rule) {
    faults_.add(file_, fmt::format("line {}", line_number_), value, rule);
  }

  void read_header() {
    if (!next_line(false) || !line_.starts_with("ply")) {
      faults_.add(file_, "line 1", "", "is no PLY file: must begin with 'ply'");
      return;
    }
    bool ended = false;
    while (!ended && next_line(false)) ended = read_header_line();
    if (!ended) faults_.add(file_, "", "", "is cut off: the header ends without 'end_header'");
    for (const Element& element : elements_) check(element);
  }

  /// Returns whether this line ends the header.
  bool read_header_line() {
    std::istringstream words(line_);
    std::string key;
    std::string name;
    words >> key >> name;
    if (key == "comment" || key == "obj_info") mesh_.header += line_ + "\n";
    if (key == "format" && name != "ascii") faults_.add(file_, "", name, "only PLY of format ascii is read");
    if (key == "element") {
      std::string count;
      words >> count;
      const auto number = whole_number<std::size_t>(count);
      if (!number) header_fault(count, "must be the number of rows of this element");
      elements_.push_back({.name = name, .count = number.value_or(0)});
    }
    if (key == "property" && elements_.empty()) header_fault(line_, "a property needs an element before it");
    if (key == "property" && !elements_.empty()) {
      std::string last;
      for (std::string word; words >> word;) last = word;
      elements_.back().properties.push_back({.name = last, .list = name == "list"});
    }
    return key == "end_header";
  }

  void check(const Element& element) {
    const auto lacks = [&](const std::string& what) {
      faults_.add(file_, "element " + element.name, "", "has no property " + what);
    };
    for (const char* axis : {"x", "y", "z"})
      if (element.name == "vertex" && !element.has(axis, false)) lacks(axis);
    if (element.name == "face" && !element.has("vertex_indices", true) && !element.has("vertex_index", true))
      lacks("list vertex_indices");
  }

  using Words = std::span<const std::string>;

  /// Returns whether there was a row to read.
  bool read_row(const Element& element, std::size_t row) {
    const std::string name = fmt::format("{} {}", element.name, row + 1);
    if (!next_line(true)) {
      rows_.add(name, "",
                fmt::format("is cut off: the header announces {}, the file ends before it", element.count));
      return false;
    }
    const std::string place = fmt::format("{} (line {})", name, line_number_);
    words_.clear();
    std::istringstream words(line_);
    for (std::string word; words >> word;) words_.push_back(word);
    const auto values = values_of(element, place);
    if (element.name == "vertex") add_vertex(element, values);
    if (element.name == "face" && values)
      add_face(element, *values, {.number = static_cast<std::uint32_t>(row + 1), .line = line_number_});
    return true;
  }

  /// The words of this row by property; nothing, with a fault, where they are not as many as it needs.
  std::optional<std::vector<Words>> values_of(const Element& element, const std::string& place) {
    std::vector<Words> values;
    Words rest(words_);
    for (const Property& property : element.properties) {
      std::optional<std::size_t> length = 1;
      if (property.list) {
        length = rest.empty() ? std::nullopt : whole_number<std::size_t>(rest.front());
        if (!rest.empty()) rest = rest.subspan(1);
      }
      if (!length || *length > rest.size()) {
        rows_.add(place, fmt::format("'{}'", line_),
                  fmt::format("has too few numbers for its property {}", property.name));
        return std::nullopt;
      }
      values.push_back(rest.first(*length));
      rest = rest.subspan(*length);
    }
    if (rest.empty()) return values;
    rows_.add(place, fmt::format("'{}'", line_), "has more numbers than its properties");
    return std::nullopt;
  }

  void add_vertex(const Element& element, const std::optional<std::vector<Words>>& values) {
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 0; values && i < values->size(); ++i) {
      const std::string& name = element.properties[i].name;
      const auto axis = name.size() == 1 ? std::string("xyz").find(name) : std::string::npos;
      if (axis != std::string::npos && !element.properties[i].list)
        point[static_cast<Eigen::Index>(axis)] = coordinate((*values)[i].front());
    }
    mesh_.vertices.push_back(point);
  }

  void add_face(const Element& element, const std::vector<Words>& values, const FacetPlace& place) {
    std::vector<long> corners;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!is_corner_list(element.properties[i])) continue;
      for (const std::string& word : values[i]) {
        const auto corner = whole_number<long>(word);
        if (!corner) {
          rows_.add(place.text(), fmt::format("corner '{}'", word), "must be the number of a vertex");
          return;
        }
        corners.push_back(*corner);
      }
    }
    polygons_.push_back({std::move(corners), place});
  }

  std::string file_;
  Faults& faults_;
  FaultKind rows_;
  std::istringstream lines_;
  std::string line_;
  std::uint32_t line_number_ = 0;
  std::vector<std::string> words_;
  std::vector<Element> elements_;
  std::vector<Polygon> polygons_;  ///< cut into facets when all vertices are known
  RawMesh mesh_;
};

}  // namespace

RawMesh parse_ply(const std::string& text, const std::string& file, Faults& faults) {
  return PlyReader(text, file, faults).read();
}

}  // namespace repose
