#pragma once

#include <string>

namespace ir::methods::deep_screen_space {

inline const std::string folder = "methods/deep-screen-space/splatting/";  ///< of the shaders

}  // namespace ir::methods::deep_screen_space
