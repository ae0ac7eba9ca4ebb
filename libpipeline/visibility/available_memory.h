#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pipeline {

/// How many bytes the system can still provide, by the text of Linux's /proc/meminfo: available memory and
/// free swap space. None if the text does not have them.
std::optional<std::uint64_t> available_memory(std::string_view meminfo);

/// Throws std::bad_alloc if the system cannot provide `size` bytes more. Linux allocates more memory than it
/// has, and kills a process that fills it. Does nothing where there is no /proc/meminfo. A container's own
/// limit is not seen.
void expect_available_memory(std::size_t size);

}  // namespace pipeline
