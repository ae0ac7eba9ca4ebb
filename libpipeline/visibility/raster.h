#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

namespace pipeline {

/// The alignment of large arrays: the size of a large page.
constexpr std::size_t kLargePage = std::size_t{1} << 21;

/// Asks the system to back `size` bytes from `begin`, a multiple of kLargePage, with large pages, where it
/// has them and lets programs choose. Filling them causes fewer page faults, and random accesses cause fewer
/// TLB misses. No result depends on whether the system complies.
void prefer_large_pages(void* begin, std::size_t size);

/// The allocator of arrays that may be large: from two large pages on, they are on large pages.
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
  friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) { return true; }

 private:
  static bool is_large(std::size_t size) { return size >= 2 * kLargePage; }
};

/// A two-dimensional array, row after row; row 0 is at the top, column 0 on the left.
template <typename T>
class Raster {
 public:
  /// `rows` x `columns` entries of `value`; both sizes are at least 0.
  Raster(int rows, int columns, const T& value)
      : rows_(rows),
        columns_(columns),
        entries_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), value) {}

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int columns() const { return columns_; }

  [[nodiscard]] std::span<T> row(int row) { return {&entries_[begin(row)], width()}; }
  [[nodiscard]] std::span<const T> row(int row) const { return {&entries_[begin(row)], width()}; }

 private:
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(columns_); }
  [[nodiscard]] std::size_t begin(int row) const {
    assert(row >= 0 && row < rows_);
    return static_cast<std::size_t>(row) * width();
  }

  int rows_;
  int columns_;
  std::vector<T, LargePageAllocator<T>> entries_;
};

}  // namespace pipeline
