# Warnings of our own code; consumers do not inherit them.
add_library(nbvopt_warnings INTERFACE)
target_compile_options(nbvopt_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  $<$<BOOL:${NBVOPT_WERROR}>:-Werror>)
