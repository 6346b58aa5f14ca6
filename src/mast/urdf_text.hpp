// What a robot's XML must be before a reader may see it whose stack is as deep as the file.
#pragma once

#include <string>

namespace nbvopt {

/// Throws InputError "<name>: ..." for text that is larger than any robot, nested deeper, or still
/// holds macros of xacro.
void check_urdf_text(const std::string& text, const std::string& name);

}  // namespace nbvopt
