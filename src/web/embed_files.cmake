# Writes OUTPUT, C++ that defines page_parts(): the content of the text files FILES by name, with
# the SHA-256 of each.
# Literals that know their length (sv): to count so many letters is too much for the compiler.
set(source "// Made by embed_files.cmake.\n#include \"web/page_parts.hpp\"\n\nnamespace nbvopt {\n\nusing namespace std::string_view_literals;\n\n")
string(APPEND source "std::span<const PagePart> page_parts() {\n  static constexpr PagePart kParts[] = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} content)
  file(SHA256 ${file} hash)
  string(FIND "${content}" ")~page~" end)
  string(FIND "${content}" "</script" script_end)
  if(NOT end EQUAL -1 OR (name MATCHES "\\.js$" AND NOT script_end EQUAL -1))
    message(FATAL_ERROR "${file} has a text that would end it early")
  endif()
  string(APPEND source "{\"${name}\", \"${hash}\", R\"~page~(${content})~page~\"sv},\n")
endforeach()
string(APPEND source "};\n  return kParts;\n}\n\n}  // namespace nbvopt\n")
file(WRITE ${OUTPUT} "${source}")
