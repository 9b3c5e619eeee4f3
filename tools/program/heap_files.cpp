#include "tools/program/heap_files.hpp"

#include "engine/output/heap_files.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/report/heap_plot.hpp"
#include "tools/report/profile_plot.hpp"

namespace repose::program {

void write_heap_files(const std::filesystem::path& folder, const RunResult& result, const std::string& title,
                      const nlohmann::ordered_json& json) {
  write_file(folder / "result.json", json.dump(2) + "\n");
  write_vtk(result.heap, folder, "heap");
  write_dump(result.heap, folder / "heap.dump", result.cost.steps);
  plot_profiles(result.measurement, folder / "profile.png", title);
  plot_heap(result.heap, folder / "heap.png");
}

}  // namespace repose::program
