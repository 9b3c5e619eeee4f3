#include "tools/program/shape_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "engine/base/input_error.hpp"
#include "tools/plot/gnuplot.hpp"
#include "tools/program/body_image.hpp"

namespace repose::program {

namespace {

/// A gnuplot that reads a script from here and writes one picture: beside its place, then renamed, so that a
/// picture is there whole or not at all.
class Gnuplot {
 public:
  Gnuplot(const std::filesystem::path& picture, int width, int height)
      : picture_(picture), part_(picture.string() + ".part") {
    std::error_code ignored;
    if (picture.has_parent_path()) std::filesystem::create_directories(picture.parent_path(), ignored);
    // Where the picture cannot be opened gnuplot goes on and writes to standard output.
    pipe_ = popen("gnuplot >/dev/null", "w");
    if (pipe_ == nullptr) throw std::runtime_error("gnuplot cannot be started");
    send(fmt::format("set terminal pngcairo size {},{} font 'sans,11'\nset output '{}'\n", width, height,
                     gnuplot_quoted(part_.string())));
  }
  ~Gnuplot() {
    if (pipe_ != nullptr) pclose(pipe_);
  }
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  void send(const std::string& text) { std::fwrite(text.data(), 1, text.size(), pipe_); }
  void send(const std::vector<std::uint8_t>& bytes) { std::fwrite(bytes.data(), 1, bytes.size(), pipe_); }
  /// Waits for the picture. Throws InputError where it cannot be written.
  void finish() {
    const int status = pclose(std::exchange(pipe_, nullptr));
    std::error_code error;
    if (status != 0 && std::filesystem::remove(part_, error))
      throw std::runtime_error(fmt::format("gnuplot did not draw {}", picture_.string()));
    std::filesystem::rename(part_, picture_, error);
    if (error) throw InputError({picture_.string(), "", "", "cannot be written: " + error.message()});
  }

 private:
  std::filesystem::path picture_;
  std::filesystem::path part_;
  std::FILE* pipe_ = nullptr;
};

}  // namespace

void draw_sphericity(const std::filesystem::path& picture, const ScanTable& table) {
  Gnuplot plot(picture, 800, 600);
  std::string data = "$particles << EOD\n";
  for (const ScannedParticle& particle : table.particles)
    data += fmt::format("{:.6g} {:.6g}\n", particle.area_mm2, particle.equivalent_area_mm2);
  plot.send(data + "EOD\n");
  plot.send(fmt::format(
      "set xlabel 'surface of the particle SA / mm^2'\nset ylabel 'surface of the sphere of equal volume / "
      "mm^2'\n"
      "set key top left\nset grid\nset xrange [0:*]\nset yrange [0:*]\n"
      "plot $particles with points pt 7 lc rgb '#336699' title '{} particles, mean sphericity {:.3f}', \\\n"
      "  {:.10g}*x+{:.10g} lw 2 lc rgb '#aa4422' title '{:.4f} SA {:+.3f} mm^2, R^2 = {:.4f}, adjusted "
      "{:.4f}', \\\n"
      "  x dt 2 lc rgb 'gray' title 'sphere'\n",
      table.particles.size(), table.mean_sphericity, table.slope, table.intercept_mm2, table.slope,
      table.intercept_mm2, table.r_squared, table.adjusted_r_squared));
  plot.finish();
}

void draw_clumps(const std::filesystem::path& picture, const Mesh& mesh, const std::vector<Clump>& clumps) {
  const Mesh body = in_principal_frame(mesh);
  double reach = 0.0;
  for (const Vec3& vertex : body.vertices) reach = std::max(reach, vertex.norm());
  for (const Clump& clump : clumps) reach = std::max(reach, clump.bounding_radius());
  BodyImage image(static_cast<int>(clumps.size()) + 1, 1.05 * reach);
  image.draw(0, body);
  Gnuplot plot(picture, image.width(), image.height() + 40);
  plot.send(fmt::format("set label 1 'mesh, {} facets' at {},-12 center\n", mesh.facets.size(),
                        BodyImage::kSide / 2));
  for (std::size_t i = 0; i < clumps.size(); ++i) {
    image.draw(static_cast<int>(i) + 1, clumps[i].spheres);
    plot.send(fmt::format("set label {} '{} spheres' at {},-12 center\n", i + 2, clumps[i].spheres.size(),
                          (static_cast<int>(i) + 1) * BodyImage::kSide + BodyImage::kSide / 2));
  }
  plot.send(fmt::format(
      "set margins 0,0,0,0\nunset border\nunset tics\nunset key\nset xrange [0:{}]\nset yrange [-40:{}]\n"
      "plot '-' binary array=({},{}) format='%uchar' with rgbimage\n",
      image.width(), image.height(), image.width(), image.height()));
  plot.send(image.pixels());
  plot.finish();
}

void draw_errors(const std::filesystem::path& picture, const std::string& name,
                 const std::vector<ErrorPoint>& points) {
  Gnuplot plot(picture, 800, 600);
  std::string data = "$errors << EOD\n";
  // An error of exactly nothing has no place on a logarithmic axis.
  const auto percent = [](double error) { return std::max(100.0 * error, 1e-6); };
  for (const ErrorPoint& point : points)
    data += fmt::format("{} {:.6g} {:.6g} {:.6g}\n", point.spheres, percent(point.volume_error),
                        percent(point.eit_error), percent(point.mean_distance));
  plot.send(data + "EOD\n");
  plot.send(fmt::format(
      "set title '{}' noenhanced\nset xlabel 'number of spheres'\nset ylabel 'error / %'\nset logscale y\n"
      "set format y '%g'\nset grid\nset key top right\n"
      "plot $errors using 1:2 with linespoints pt 7 lw 2 title 'volume', \\\n"
      "  '' using 1:3 with linespoints pt 5 lw 2 title 'inertia (EIT)', \\\n"
      "  '' using 1:4 with linespoints pt 9 lw 2 title 'surface, mean distance / equivalent diameter'\n",
      name));
  plot.finish();
}

}  // namespace repose::program
