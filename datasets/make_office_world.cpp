// Writes office.world.
#include <exception>
#include <iostream>

#include "core/atomic_file.hpp"
#include "office_world.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_office_world OUT.world\n";
    return 2;
  }
  try {
    nbvopt::write_file_atomically(argv[1], nbvopt::office_world());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
