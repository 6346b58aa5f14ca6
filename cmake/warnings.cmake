# Warnings of our own code; consumers do not inherit them. GCC 12 finds overlapping copies in plain
# string concatenation (GCC bug 105651), so -Wrestrict is off.
add_library(nbvopt_warnings INTERFACE)
target_compile_options(nbvopt_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${NBVOPT_WERROR}>:-Werror>)

# Files that are compiled together would be told that they shadow each other's names, and GCC takes
# all of them but one for headers, where it expects no unnamed namespace.
set(nbvopt_is_unity $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
target_compile_options(nbvopt_warnings INTERFACE
  $<$<NOT:${nbvopt_is_unity}>:-Wshadow>
  "$<$<AND:${nbvopt_is_unity},$<CXX_COMPILER_ID:GNU>>:-Wshadow=local;-Wno-subobject-linkage>")
