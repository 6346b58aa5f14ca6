// Makes the map that ships: make_office OUT.ot
#include <cstdlib>
#include <iostream>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "office_partial.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_office OUT.ot\n";
    return 2;
  }
  try {
    const nbvopt::UncertaintyMap map = nbvopt::make_office_partial();
    nbvopt::write_map(map, argv[1], nbvopt::MapFormat::uncertainty_ot);
    const nbvopt::MapCounts counts = map.counts();
    std::cout << argv[1] << ": " << counts.occupied_voxels << " occupied and " << counts.free_voxels
              << " free voxels, information " << counts.information << ", " << counts.nodes
              << " nodes\n";
  } catch (const nbvopt::InputError& error) {
    std::cerr << "make_office: " << error.what() << '\n';
    return 3;
  }
  return EXIT_SUCCESS;
}
