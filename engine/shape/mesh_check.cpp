#include "engine/shape/mesh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/shape/facet_crossing.hpp"
#include "engine/shape/facet_tree.hpp"
#include "engine/shape/fault_kind.hpp"

namespace repose {

namespace {

/// Facets that break one rule.
class Kind {
 public:
  Kind(Faults& faults, const std::string& file, const FacetName& name_of, std::string rule)
      : faults_(faults, file, "facets"), name_of_(name_of), rule_(std::move(rule)) {}
  void add(std::size_t facet, const std::string& detail = "") { faults_.add(name_of_(facet), detail, rule_); }
  [[nodiscard]] std::size_t count() const { return faults_.count(); }

 private:
  FaultKind faults_;
  const FacetName& name_of_;
  std::string rule_;
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;
struct Side {
  std::size_t facet;
  bool forward;  ///< runs from the lower vertex to the higher
};
using Edges = std::map<Edge, std::vector<Side>>;

Edges edges_of(const Mesh& mesh) {
  Edges edges;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.facets[f][k];
      const std::uint32_t b = mesh.facets[f][(k + 1) % 3];
      edges[std::minmax(a, b)].push_back({f, a < b});
    }
  }
  return edges;
}

bool has_no_area(const Mesh& mesh, const Facet& facet) {
  const Vec3& a = mesh.vertices[facet[0]];
  const Vec3& b = mesh.vertices[facet[1]];
  const Vec3& c = mesh.vertices[facet[2]];
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return (b - a).cross(c - a).norm() <= 1e-9 * longest * longest;
}

void check_edges(const Edges& edges, const std::string& file, const FacetName& name_of, Faults& faults) {
  Kind open(faults, file, name_of, "has an edge without a neighbour: the surface is open");
  Kind shared(faults, file, name_of, "has an edge that more than two facets share");
  for (const auto& [edge, sides] : edges) {
    if (sides.size() == 1) open.add(sides.front().facet);
    if (sides.size() > 2) shared.add(sides.front().facet, fmt::format("{} facets", sides.size()));
  }
}

/// Facets by the surface that they belong to and by whether they agree with its first facet.
struct Surfaces {
  std::vector<std::size_t> first;   ///< first facet of every connected surface
  std::vector<std::size_t> number;  ///< per facet
  std::vector<bool> turned;         ///< per facet
  bool one_sided = false;           ///< no orientation agrees with all edges
};

Surfaces walk(const Mesh& mesh, const Edges& edges) {
  struct Step {
    std::size_t facet;
    bool turns;
  };
  std::vector<std::vector<Step>> neighbours(mesh.facets.size());
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) continue;
    const bool turns = sides[0].forward == sides[1].forward;
    neighbours[sides[0].facet].push_back({sides[1].facet, turns});
    neighbours[sides[1].facet].push_back({sides[0].facet, turns});
  }
  const std::size_t unseen = mesh.facets.size();
  Surfaces surfaces;
  surfaces.number.assign(mesh.facets.size(), unseen);
  surfaces.turned.assign(mesh.facets.size(), false);
  for (std::size_t start = 0; start < mesh.facets.size(); ++start) {
    if (surfaces.number[start] != unseen) continue;
    surfaces.first.push_back(start);
    surfaces.number[start] = surfaces.first.size() - 1;
    std::vector<std::size_t> open = {start};
    while (!open.empty()) {
      const std::size_t facet = open.back();
      open.pop_back();
      for (const Step& step : neighbours[facet]) {
        const bool turned = surfaces.turned[facet] != step.turns;
        if (surfaces.number[step.facet] == unseen) {
          surfaces.number[step.facet] = surfaces.first.size() - 1;
          surfaces.turned[step.facet] = turned;
          open.push_back(step.facet);
        } else if (surfaces.turned[step.facet] != turned) {
          surfaces.one_sided = true;
        }
      }
    }
  }
  return surfaces;
}

/// The smaller party of every surface is the one that is turned. Returns whether all facets agree.
bool check_orientation(const Surfaces& surfaces, const std::string& file, const FacetName& name_of,
                       Faults& faults) {
  if (surfaces.one_sided) {
    faults.add(file, "", "", "has no inside: its facets cannot be oriented alike");
    return false;
  }
  std::vector<std::array<std::size_t, 2>> parties(surfaces.first.size());
  for (std::size_t f = 0; f < surfaces.number.size(); ++f) ++parties[surfaces.number[f]][surfaces.turned[f]];
  Kind kind(faults, file, name_of, "is turned against its neighbours");
  for (std::size_t f = 0; f < surfaces.number.size(); ++f) {
    const auto& [straight, turned] = parties[surfaces.number[f]];
    if (surfaces.turned[f] == (turned <= straight) && std::min(straight, turned) > 0) kind.add(f);
  }
  return kind.count() == 0;
}

void check_volume(const Mesh& mesh, bool closed_and_oriented, const std::string& file, Faults& faults) {
  if (!closed_and_oriented) return;
  constexpr double kFlat = 1e-4;  // sphericity of a sheet about 1e-6 as thick as wide
  const MeshMeasures body = measure(mesh);
  if (body.sphericity() < kFlat)
    faults.add(file, "", "", "encloses no volume");
  else if (body.volume < 0.0)
    faults.add(file, "", "", "all facets face inwards");
}

}  // namespace

std::string facet_number(std::size_t facet) { return fmt::format("facet {}", facet + 1); }

Faults check_mesh(const Mesh& mesh, const std::string& file, const FacetName& name_of) {
  Faults faults;
  if (mesh.facets.empty()) {
    faults.add(file, "", "", "holds no facets");
    return faults;
  }
  {
    Kind flat(faults, file, name_of, "has no area");
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
      if (has_no_area(mesh, mesh.facets[f])) flat.add(f);
  }
  const Edges edges = edges_of(mesh);
  check_edges(edges, file, name_of, faults);
  const bool closed = faults.empty();
  const Surfaces surfaces = walk(mesh, edges);
  const bool oriented = check_orientation(surfaces, file, name_of, faults);
  for (std::size_t i = 1; closed && i < std::min(surfaces.first.size(), kNamedFaults); ++i)
    faults.add(file, name_of(surfaces.first[i]), "",
               "begins a second surface apart from the first: a particle is one body without cavities");
  check_volume(mesh, closed && oriented, file, faults);
  {
    Kind crossing(faults, file, name_of, "crosses another facet");
    FacetTree(mesh).for_each_close_pair([&](std::size_t f, std::size_t g) {
      if (!facets_cross(mesh, f, g)) return;
      const std::string other = name_of(g);
      crossing.add(f, other == name_of(f) ? "with itself, cut into triangles" : "with " + other);
    });
  }
  return faults;
}

}  // namespace repose
