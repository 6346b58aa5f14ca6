// Drives through a room made in memory, with the installed package's simulator.
#include <cstdio>

#include "nbvopt/sim/episode.hpp"

int main() {
  // A floor and a wall, two triangles each.
  nbvopt::TriangleMesh mesh;
  mesh.vertices_m = {{-5.0F, -5.0F, 0.0F}, {5.0F, -5.0F, 0.0F}, {5.0F, 5.0F, 0.0F},
                     {-5.0F, 5.0F, 0.0F},  {3.0F, -5.0F, 0.0F}, {3.0F, 5.0F, 0.0F},
                     {3.0F, 5.0F, 3.0F},   {3.0F, -5.0F, 3.0F}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  const nbvopt::Scene scene(mesh);
  const nbvopt::Trajectory drive({{.time_s = 0.0}, {.time_s = 2.0, .x_m = 0.5}});
  nbvopt::UncertaintyMap map(0.1);
  const nbvopt::EpisodeSummary summary = nbvopt::run_episode(
      scene, drive, *nbvopt::make_camera_mode("auto"), {}, map, [](const nbvopt::Capture&) {});
  std::printf("%d captures, information %.0f\n", static_cast<int>(summary.captures),
              summary.information);
  return summary.captures == 5 && summary.information > 0.0 ? 0 : 1;
}
