#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string_view>
#include <type_traits>

namespace pipeline {

/// The alignment of large arrays: the size of a large page.
constexpr std::size_t kLargePage = std::size_t{1} << 21;

/// Asks the system to back `size` bytes from `begin`, a multiple of kLargePage, with large pages, if it has
/// them and lets programs choose. Filling them causes fewer page faults, and random accesses cause fewer TLB
/// misses. No result depends on whether the system complies.
void prefer_large_pages(void* begin, std::size_t size);

/// The allocator of arrays that may be large: from a size of two large pages on, they are on large pages.
/// Entries without a given value are uninitialized.
template <typename T>
struct LargePageAllocator {
  using value_type = T;

  LargePageAllocator() = default;
  template <typename U>
  explicit LargePageAllocator(const LargePageAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t count) {
    if (count > PTRDIFF_MAX / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t size = count * sizeof(T);
    if (!is_large(size)) return static_cast<T*>(::operator new(size));
    void* const begin = ::operator new (size, std::align_val_t{kLargePage});
    prefer_large_pages(begin, size);
    return static_cast<T*>(begin);
  }
  void deallocate(T* begin, std::size_t count) noexcept {
    if (is_large(count * sizeof(T)))
      ::operator delete (begin, std::align_val_t{kLargePage});
    else
      ::operator delete(begin);
  }
  void construct(T*) { static_assert(std::is_trivially_copyable_v<T>); }

  friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) { return true; }

 private:
  static bool is_large(std::size_t size) { return size >= 2 * kLargePage; }
};

/// The bytes that the system can still provide, according to the text of Linux's /proc/meminfo: available
/// memory and free swap space. None if the text does not have them.
std::optional<std::uint64_t> available_memory(std::string_view meminfo);

/// Throws std::bad_alloc if the system cannot provide `size` bytes more. Linux grants more memory than it
/// has, and kills a process that uses it. Does nothing where there is no /proc/meminfo. Ignores a container's
/// own limit.
void expect_available_memory(std::size_t size);

}  // namespace pipeline
