#pragma once

#include <string>
#include <string_view>

namespace pipeline {

/// The first coordinate in an OBJ, STL or PLY text that is neither the shortest text of its float, which a
/// scene has, nor its float rounded to as many decimals, six at most: "LINE:COLUMN: ..." for a note, else
/// nothing.
std::string lost_digits(std::string_view model);

}  // namespace pipeline
