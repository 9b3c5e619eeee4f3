#include "engine/shape/union_of_spheres.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace repose {

namespace {

/// ∫ cos^m φ sin^n φ dφ over the exposed arcs of one circle, m + n ≤ 3.
struct ArcIntegrals {
  double one = 0, c = 0, s = 0, cc = 0, cs = 0, ss = 0, ccc = 0, ccs = 0, css = 0, sss = 0;

  void add_arc(double from, double to) {
    const double c0 = std::cos(from);
    const double s0 = std::sin(from);
    const double c1 = std::cos(to);
    const double s1 = std::sin(to);
    const double half = 0.5 * (s1 * c1 - s0 * c0);
    const double cubes_c = (c1 * c1 * c1 - c0 * c0 * c0) / 3.0;
    const double cubes_s = (s1 * s1 * s1 - s0 * s0 * s0) / 3.0;
    one += to - from;
    c += s1 - s0;
    s += c0 - c1;
    cc += 0.5 * (to - from) + half;
    ss += 0.5 * (to - from) - half;
    cs += 0.5 * (s1 * s1 - s0 * s0);
    ccc += s1 - s0 - cubes_s;
    ccs -= cubes_c;
    css += cubes_s;
    sss += c0 - c1 + cubes_c;
  }

  void add_circle() {
    one += 2.0 * kPi;
    cc += kPi;
    ss += kPi;
  }
};

/// Where a sphere is cut; radius 0 where it is not.
struct Circle {
  std::size_t sphere;
  double x, y, radius;
};

struct Interval {
  double from, to;
};

/// Arcs of a circle that no other circle of the cut covers.
/// @param neighbours  spheres that overlap the circle's
ArcIntegrals exposed_arcs(const Circle& circle, const std::vector<Circle>& cut,
                          const std::vector<std::size_t>& neighbours, std::vector<Interval>& covered) {
  covered.clear();
  for (const std::size_t neighbour : neighbours) {
    const Circle& other = cut[neighbour];
    if (other.radius == 0.0) continue;
    const double dx = other.x - circle.x;
    const double dy = other.y - circle.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (distance >= circle.radius + other.radius || distance <= circle.radius - other.radius) {
      // Of two equal circles the one of lower index is the exposed one.
      if (!(distance == 0.0 && circle.radius == other.radius && other.sphere < circle.sphere)) continue;
    }
    if (distance <= other.radius - circle.radius) return {};
    const double cosine =
        (circle.radius * circle.radius + distance * distance - other.radius * other.radius) /
        (2.0 * circle.radius * distance);
    const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double middle = std::atan2(dy, dx);
    if (middle - half < -kPi) {
      covered.push_back({middle - half + 2.0 * kPi, kPi});
      covered.push_back({-kPi, middle + half});
    } else if (middle + half > kPi) {
      covered.push_back({middle - half, kPi});
      covered.push_back({-kPi, middle + half - 2.0 * kPi});
    } else {
      covered.push_back({middle - half, middle + half});
    }
  }
  ArcIntegrals arcs;
  if (covered.empty()) {
    arcs.add_circle();
    return arcs;
  }
  std::sort(covered.begin(), covered.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double reached = -kPi;
  for (const Interval& interval : covered) {
    if (interval.from > reached) arcs.add_arc(reached, interval.from);
    reached = std::max(reached, interval.to);
  }
  if (reached < kPi) arcs.add_arc(reached, kPi);
  return arcs;
}

/// ∫ g dφ, ∫ g cos φ dφ, ∫ g sin φ dφ over the arcs, for g = 1, x, y, xx, yy, xy.
std::array<Vec3, 6> weighted(const Circle& circle, const ArcIntegrals& t) {
  const double x = circle.x;
  const double y = circle.y;
  const double r = circle.radius;
  const Vec3 one(t.one, t.c, t.s);
  const Vec3 c(t.c, t.cc, t.cs);
  const Vec3 s(t.s, t.cs, t.ss);
  const Vec3 cc(t.cc, t.ccc, t.ccs);
  const Vec3 ss(t.ss, t.css, t.sss);
  const Vec3 cs(t.cs, t.ccs, t.css);
  return {one,
          x * one + r * c,
          y * one + r * s,
          x * x * one + 2.0 * x * r * c + r * r * cc,
          y * y * one + 2.0 * y * r * s + r * r * ss,
          x * y * one + r * (x * s + y * c) + r * r * cs};
}

/// The ten moments' densities in z, from those of the cut: 1, x, y, xx, yy, xy.
Moments with_z(const std::array<double, 6>& cut, double z) {
  Moments moments;
  moments << cut[0], cut[1], cut[2], z * cut[0], cut[3], cut[4], z * z * cut[0], cut[5], z * cut[1],
      z * cut[2];
  return moments;
}

/// Where spheres begin and end, the cut changes its form: panels end there, unless another end is near.
std::vector<double> panel_ends(std::span<const Sphere> spheres, int panels) {
  std::vector<double> natural;
  for (const Sphere& sphere : spheres) {
    natural.push_back(sphere.centre.z() - sphere.radius);
    natural.push_back(sphere.centre.z() + sphere.radius);
  }
  std::sort(natural.begin(), natural.end());
  const double width = (natural.back() - natural.front()) / panels;
  std::vector<double> ends = {natural.front()};
  for (const double end : natural) {
    const double gap = end - ends.back();
    if (gap < 0.25 * width && end != natural.back()) continue;
    const int parts = std::max(1, static_cast<int>(std::ceil(gap / width)));
    const double start = ends.back();
    for (int part = 1; part <= parts; ++part) ends.push_back(start + gap * part / parts);
  }
  return ends;
}

/// For every sphere those that overlap it, the largest first: what covers a circle whole is found early.
std::vector<std::vector<std::size_t>> overlaps(std::span<const Sphere> spheres) {
  std::vector<std::size_t> by_size(spheres.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](std::size_t a, std::size_t b) { return spheres[a].radius > spheres[b].radius; });
  std::vector<std::vector<std::size_t>> neighbours(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (const std::size_t j : by_size)
      if (j != i && (spheres[i].centre - spheres[j].centre).norm() < spheres[i].radius + spheres[j].radius)
        neighbours[i].push_back(j);
  return neighbours;
}

/// What all cuts share.
struct Scratch {
  std::vector<std::vector<std::size_t>> neighbours;
  std::vector<Circle> cut;
  std::vector<Interval> covered;
};

void add_cut(std::span<const Sphere> spheres, double z, double weight, UnionOfSpheres& sum,
             Scratch& scratch) {
  scratch.cut.resize(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double dz = z - spheres[i].centre.z();
    const double square = spheres[i].radius * spheres[i].radius - dz * dz;
    scratch.cut[i] = {i, spheres[i].centre.x(), spheres[i].centre.y(), std::sqrt(std::max(0.0, square))};
  }
  for (const Circle& circle : scratch.cut) {
    if (circle.radius == 0.0) continue;
    const ArcIntegrals arcs =
        exposed_arcs(circle, scratch.cut, scratch.neighbours[circle.sphere], scratch.covered);
    if (arcs.one == 0.0) continue;
    const Sphere& sphere = spheres[circle.sphere];
    const std::array<Vec3, 6> g = weighted(circle, arcs);
    const Vec3 form = circle.radius * Vec3(circle.radius, circle.x, circle.y);  // x dy − y dx over dφ
    sum.moments += weight * with_z({form.dot(g[0]) / 2, form.dot(g[1]) / 3, form.dot(g[2]) / 3,
                                    form.dot(g[3]) / 4, form.dot(g[4]) / 4, form.dot(g[5]) / 4},
                                   z);
    sum.exposed[circle.sphere] += weight * sphere.radius * arcs.one;
    if (sum.gradient.size() == 0) continue;
    const auto column = [&](std::size_t k) {
      return with_z({g[0][static_cast<Eigen::Index>(k)], g[1][static_cast<Eigen::Index>(k)],
                     g[2][static_cast<Eigen::Index>(k)], g[3][static_cast<Eigen::Index>(k)],
                     g[4][static_cast<Eigen::Index>(k)], g[5][static_cast<Eigen::Index>(k)]},
                    z);
    };
    auto block = sum.gradient.middleCols<4>(4 * static_cast<Eigen::Index>(circle.sphere));
    const Moments plain = column(0);
    block.col(0) += weight * circle.radius * column(1);
    block.col(1) += weight * circle.radius * column(2);
    block.col(2) += weight * (z - sphere.centre.z()) * plain;
    block.col(3) += weight * sphere.radius * plain;
  }
}

}  // namespace

UnionOfSpheres unite(std::span<const Sphere> spheres, int panels, bool with_gradient) {
  UnionOfSpheres sum;
  sum.exposed.assign(spheres.size(), 0.0);
  if (with_gradient)
    sum.gradient = Eigen::MatrixXd::Zero(kMoments, 4 * static_cast<Eigen::Index>(spheres.size()));
  if (spheres.empty()) return sum;
  const std::vector<double> ends = panel_ends(spheres, panels);
  const double node = std::sqrt(0.6);
  Scratch scratch{overlaps(spheres), {}, {}};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double half = 0.5 * (ends[i + 1] - ends[i]);
    const double middle = 0.5 * (ends[i + 1] + ends[i]);
    if (half <= 0.0) continue;
    add_cut(spheres, middle - node * half, half * 5.0 / 9.0, sum, scratch);
    add_cut(spheres, middle, half * 8.0 / 9.0, sum, scratch);
    add_cut(spheres, middle + node * half, half * 5.0 / 9.0, sum, scratch);
  }
  for (const double area : sum.exposed) sum.area += area;
  return sum;
}

MassProperties mass_properties(const Moments& m) {
  MassProperties body;
  body.volume = m[0];
  body.centre = m.segment<3>(1) / m[0];
  Mat3 second;
  second << m[4], m[7], m[8], m[7], m[5], m[9], m[8], m[9], m[6];
  second -= m[0] * body.centre * body.centre.transpose();
  body.inertia = second.trace() * Mat3::Identity() - second;
  return body;
}

}  // namespace repose
