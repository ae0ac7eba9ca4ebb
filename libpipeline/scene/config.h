#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// Reads config.txt: a line `columns rows`, alone (left and bottom are then -1, and z lies in [-1, 1]) or
/// followed by a line `left`, a line `bottom` and a line `front rear`. Sizes are whole numbers from 1 to
/// kMaxViewportSize, left and bottom lie in [-kMaxLimit, -kMinLimit], front < rear. An InputError at anything
/// that is wrong, missing or left over.
Viewport read_config(TextReader& text);

/// The whole numbers before and after a separator, as in `400x300`; nullopt for any other word.
std::optional<std::pair<std::uint64_t, std::uint64_t>> parse_pair(std::string_view word, char separator);

/// The viewport of a config given as one word, `WIDTHxHEIGHT`; nullopt for any other word.
std::optional<Viewport> parse_size(std::string_view word);

}  // namespace pipeline
