#include "engine/shape/facet_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace repose {

Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

FacetTree::FacetTree(const Mesh& mesh) : mesh_(&mesh), order_(mesh.facets.size()) {
  std::vector<Vec3> middles;
  for (const Facet& facet : mesh.facets) {
    Box box;
    for (const std::uint32_t corner : facet) box.extend(mesh.vertices[corner]);
    boxes_.push_back(box);
    middles.push_back(box.center());
  }
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (order_.empty()) return;
  nodes_.push_back({.box = {}, .first = 0, .count = order_.size(), .left = 0});
  split(0, middles);
}

void FacetTree::split(std::size_t node, const std::vector<Vec3>& middles) {
  constexpr std::size_t kLeaf = 4;
  const std::size_t first = nodes_[node].first;
  const std::size_t count = nodes_[node].count;
  Box spread;
  for (std::size_t i = first; i < first + count; ++i) {
    nodes_[node].box.extend(boxes_[order_[i]]);
    spread.extend(middles[order_[i]]);
  }
  if (count <= kLeaf) return;
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::size_t half = count / 2;
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                   begin + static_cast<std::ptrdiff_t>(count), [&](std::size_t f, std::size_t g) {
                     return std::pair(middles[f][axis], f) < std::pair(middles[g][axis], g);
                   });
  const std::size_t left = nodes_.size();
  nodes_[node].left = left;
  nodes_[node].count = 0;
  nodes_.push_back({.box = {}, .first = first, .count = half, .left = 0});
  nodes_.push_back({.box = {}, .first = first + half, .count = count - half, .left = 0});
  split(left, middles);
  split(left + 1, middles);
}

double FacetTree::distance(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::size_t>> open;
  if (!nodes_.empty()) open.emplace_back(nodes_.front().box.squaredExteriorDistance(p), 0);
  while (!open.empty()) {
    const auto [bound, index] = open.back();
    open.pop_back();
    if (bound >= best) continue;
    const Node& node = nodes_[index];
    for (std::size_t i = node.first; i < node.first + node.count; ++i) {
      const auto& [a, b, c] = mesh_->facets[order_[i]];
      const Vec3 q = closest_on_triangle(p, mesh_->vertices[a], mesh_->vertices[b], mesh_->vertices[c]);
      best = std::min(best, (q - p).squaredNorm());
    }
    if (node.count > 0) continue;
    std::pair near(nodes_[node.left].box.squaredExteriorDistance(p), node.left);
    std::pair far(nodes_[node.left + 1].box.squaredExteriorDistance(p), node.left + 1);
    if (far < near) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return std::sqrt(best);
}

void FacetTree::for_each_close_pair(const std::function<void(std::size_t, std::size_t)>& visit) const {
  if (!nodes_.empty()) pairs_of(0, 0, visit);
}

void FacetTree::pairs_of(std::size_t a, std::size_t b,
                         const std::function<void(std::size_t, std::size_t)>& visit) const {
  const Node& left = nodes_[a];
  const Node& right = nodes_[b];
  if (!left.box.intersects(right.box)) return;
  if (left.count > 0 && right.count > 0) {
    for (std::size_t i = left.first; i < left.first + left.count; ++i) {
      for (std::size_t j = a == b ? i + 1 : right.first; j < right.first + right.count; ++j) {
        const auto [f, g] = std::minmax(order_[i], order_[j]);
        if (boxes_[f].intersects(boxes_[g])) visit(f, g);
      }
    }
  } else if (a == b) {
    pairs_of(left.left, left.left, visit);
    pairs_of(left.left + 1, left.left + 1, visit);
    pairs_of(left.left, left.left + 1, visit);
  } else if (right.count > 0 || (left.count == 0 && left.box.volume() > right.box.volume())) {
    pairs_of(left.left, b, visit);
    pairs_of(left.left + 1, b, visit);
  } else {
    pairs_of(a, right.left, visit);
    pairs_of(a, right.left + 1, visit);
  }
}

}  // namespace repose
