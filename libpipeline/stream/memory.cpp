#include "libpipeline/stream/memory.h"

#include <fcntl.h>
#ifdef __linux__
#include <sys/mman.h>
#endif
#include <unistd.h>

#include <array>

#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

/// The number in the line "NAME:   NUMBER kB", in bytes.
std::optional<std::uint64_t> bytes_of(std::string_view name, std::string_view meminfo) {
  const std::size_t begin = meminfo.find(name);
  if (begin == std::string_view::npos) return std::nullopt;
  std::string_view line = meminfo.substr(begin + name.size());
  line = line.substr(0, line.find('\n'));
  if (!line.ends_with(" kB")) return std::nullopt;
  line.remove_suffix(3);
  std::uint64_t kibibytes = 0;
  if (!parse_count(line.substr(line.find_last_of(' ') + 1), kibibytes)) return std::nullopt;
  return kibibytes << 10;
}

}  // namespace

std::optional<std::uint64_t> available_memory(std::string_view meminfo) {
  const std::optional<std::uint64_t> memory = bytes_of("\nMemAvailable:", meminfo);
  const std::optional<std::uint64_t> swap = bytes_of("\nSwapFree:", meminfo);
  if (!memory || !swap) return std::nullopt;
  return *memory + *swap;
}

void expect_available_memory(std::size_t size) {
  const int file = ::open("/proc/meminfo", O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  std::array<char, 4096> text{};  // twice the file's length
  const ssize_t length = ::read(file, text.data(), text.size());
  ::close(file);
  if (length <= 0) return;
  const std::optional<std::uint64_t> available =
      available_memory({text.data(), static_cast<std::size_t>(length)});
  if (available && *available < size) throw std::bad_alloc();
}

void prefer_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t size) {
#ifdef MADV_HUGEPAGE
  // The tail stays on small pages, so nothing is over-allocated.
  madvise(begin, size, MADV_HUGEPAGE);
#endif
}

}  // namespace pipeline
