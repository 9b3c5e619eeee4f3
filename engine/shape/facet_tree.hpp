#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "engine/shape/mesh.hpp"

namespace repose {

/// Closest point of the triangle (a, b, c) to p (Ericson, Real-Time Collision Detection 5.1.5).
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Boxes within boxes over the facets of a mesh, which must outlive the tree.
class FacetTree {
 public:
  explicit FacetTree(const Mesh& mesh);

  /// Distance of p from the surface [length of the mesh]; infinite for a mesh without facets.
  [[nodiscard]] double distance(const Vec3& p) const;
  /// Calls visit(f, g), f < g, for every two facets whose boxes overlap.
  void for_each_close_pair(const std::function<void(std::size_t, std::size_t)>& visit) const;

 private:
  using Box = Eigen::AlignedBox3d;
  struct Node {
    Box box;
    std::size_t first = 0;  ///< into order_
    std::size_t count = 0;  ///< of a leaf; 0 for a node with two children, `left` and `left` + 1
    std::size_t left = 0;
  };
  void split(std::size_t node, const std::vector<Vec3>& middles);
  void pairs_of(std::size_t a, std::size_t b,
                const std::function<void(std::size_t, std::size_t)>& visit) const;

  const Mesh* mesh_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace repose
