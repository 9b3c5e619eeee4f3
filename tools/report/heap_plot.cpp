#include "tools/report/heap_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

#include "tools/plot/gnuplot.hpp"

namespace repose {

namespace {

constexpr double kToMm = 1e3;
constexpr int kPixels = 1200;  ///< of the picture's width

/// Seen from direction (cos A cos E, sin A cos E, sin E).
struct View {
  double azimuth = radians(35.0), elevation = radians(18.0);
  [[nodiscard]] Disc project(const Vec3& p, double radius, int shade) const {
    const double toward = p.x() * std::cos(azimuth) + p.y() * std::sin(azimuth);
    return {kToMm * (p.y() * std::cos(azimuth) - p.x() * std::sin(azimuth)),
            kToMm * (p.z() * std::cos(elevation) - toward * std::sin(elevation)), kToMm * radius,
            toward * std::cos(elevation) + p.z() * std::sin(elevation), shade};
  }
};

/// Rock colours, by body, so that the spheres of one particle belong together.
int rock_colour(int body, double light) {
  const int variation = static_cast<int>((static_cast<unsigned>(body) * 2654435761U) >> 26U);  // 0 … 63
  const auto channel = [&](int base) {
    return std::clamp(static_cast<int>(light * (base + 0.6 * (variation - 32))), 0, 255);
  };
  return channel(150) << 16 | channel(112) << 8 | channel(92);
}

}  // namespace

/// From the front to the back, over a raster of cells that discs in front cover whole.
std::vector<Disc> visible_discs(std::vector<Disc> discs, double cell) {
  if (discs.empty()) return discs;
  std::ranges::sort(discs, std::greater(), &Disc::depth);
  double low_u = discs[0].u, high_u = low_u, low_v = discs[0].v, high_v = low_v;
  for (const Disc& disc : discs) {
    low_u = std::min(low_u, disc.u - disc.radius), high_u = std::max(high_u, disc.u + disc.radius);
    low_v = std::min(low_v, disc.v - disc.radius), high_v = std::max(high_v, disc.v + disc.radius);
  }
  // Strays that are far away make cells larger rather than the raster; larger cells hide less.
  constexpr double kMostCells = 4096.0;
  cell = std::max({cell, (high_u - low_u) / kMostCells, (high_v - low_v) / kMostCells});
  const auto across = static_cast<std::size_t>((high_u - low_u) / cell) + 1,
             down = static_cast<std::size_t>((high_v - low_v) / cell) + 1;
  std::vector<char> covered(across * down, 0);
  const auto is_seen = [&](const Disc& disc) {
    bool seen = false;
    const auto first = [&](double at, double low) {
      return static_cast<std::size_t>(std::max(0.0, (at - low) / cell));
    };
    const std::size_t end_u = std::min(first(disc.u + disc.radius, low_u), across - 1),
                      end_v = std::min(first(disc.v + disc.radius, low_v), down - 1);
    for (std::size_t row = first(disc.v - disc.radius, low_v); row <= end_v; ++row)
      for (std::size_t column = first(disc.u - disc.radius, low_u); column <= end_u; ++column) {
        const double du = std::abs(low_u + (static_cast<double>(column) + 0.5) * cell - disc.u),
                     dv = std::abs(low_v + (static_cast<double>(row) + 0.5) * cell - disc.v);
        const double near_u = std::max(0.0, du - 0.5 * cell), near_v = std::max(0.0, dv - 0.5 * cell);
        if (near_u * near_u + near_v * near_v >= disc.radius * disc.radius) continue;  // not touched
        char& is_covered = covered[row * across + column];
        seen |= is_covered == 0;
        const double far_u = du + 0.5 * cell, far_v = dv + 0.5 * cell;
        if (far_u * far_u + far_v * far_v <= disc.radius * disc.radius) is_covered = 1;
      }
    return seen;
  };
  std::vector<Disc> seen;
  for (const Disc& disc : discs)
    if (is_seen(disc)) seen.push_back(disc);
  std::ranges::reverse(seen);
  return seen;
}

void plot_heap(const HeapSnapshot& heap, const std::filesystem::path& png) {
  const View view;
  std::vector<Disc> discs;
  double reach = 0.05, top = 0.02;
  for (const SphereSnapshot& sphere : heap.spheres) {
    discs.push_back(view.project(sphere.centre, sphere.radius, sphere.body));
    reach = std::max({reach, std::abs(sphere.centre.x()), std::abs(sphere.centre.y())});
    top = std::max(top, sphere.centre.z() + sphere.radius);
  }
  const bool bounded = !std::isinf(heap.base_radius);
  if (bounded) reach = 1.02 * heap.base_radius;

  const double width = kToMm * reach * (bounded ? 1.05 : 1.6);
  discs = visible_discs(std::move(discs), 2.0 * width / kPixels);

  // Each sphere is a dark disc and, towards the light at the upper left, two smaller brighter ones.
  std::string data = "$spheres << EOD\n";
  auto out = std::back_inserter(data);
  for (const Disc& disc : discs)
    for (const auto& [size, shift, light] :
         {std::array{1.0, 0.0, 0.55}, std::array{0.82, 0.12, 0.9}, std::array{0.5, 0.26, 1.15}})
      fmt::format_to(out, "{:.3f} {:.3f} {:.3f} {}\n", disc.u - shift * disc.radius,
                     disc.v + shift * disc.radius, size * disc.radius, rock_colour(disc.shade, light));
  data += "EOD\n$base << EOD\n";
  for (int k = 0; k <= 180 && bounded; ++k) {
    const double a = 2.0 * kPi * k / 180.0;
    const Disc point =
        view.project({heap.base_radius * std::cos(a), heap.base_radius * std::sin(a), 0.0}, 0.0, 0);
    fmt::format_to(out, "{:.3f} {:.3f}\n", point.u, point.v);
  }
  if (!bounded)
    for (const auto& [x, y] :
         {std::array{-1.1, -1.1}, std::array{1.1, -1.1}, std::array{1.1, 1.1}, std::array{-1.1, 1.1}}) {
      const Disc point = view.project({x * reach, y * reach, 0.0}, 0.0, 0);
      fmt::format_to(out, "{:.3f} {:.3f}\n", point.u, point.v);
    }
  data += "EOD\n";

  const double low = -width * std::sin(view.elevation) * 1.1,
               high = std::max(1.1 * kToMm * top * std::cos(view.elevation),
                               1.1 * width * std::sin(view.elevation));
  run_gnuplot(fmt::format(
      "set terminal pngcairo size {},{} background '#ffffff'\nset output '{}'\n{}"
      "unset border\nunset tics\nunset key\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
      "set xrange [{:.3f}:{:.3f}]\nset yrange [{:.3f}:{:.3f}]\nset size ratio -1\n"
      "plot $base with filledcurves closed fc rgb '#dfe4e8', $base with lines lw 1.5 lc rgb '#a3adb8', "
      "$spheres using 1:2:3:4 with circles fill solid noborder lc rgb variable\n",
      kPixels, static_cast<int>(kPixels * (high - low) / (2.0 * width)), gnuplot_quoted(png.string()), data,
      -width, width, low, high));
}

}  // namespace repose
