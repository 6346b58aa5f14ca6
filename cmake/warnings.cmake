# Warnings of our own code; consumers do not inherit them. GCC 12 finds overlapping copies in plain
# string concatenation (GCC bug 105651), so -Wrestrict is off. Files that are compiled together would
# be told that they shadow each other's names.
add_library(nbvopt_warnings INTERFACE)
target_compile_options(nbvopt_warnings INTERFACE
  -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow> -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${NBVOPT_WERROR}>:-Werror>)
