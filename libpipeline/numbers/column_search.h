#pragma once

namespace pipeline {

/// The first column in [first, end) for which `is_true` holds, or `end`, by bisection: the predicate must
/// hold for all columns after the first one for which it does.
template <typename Predicate>
int first_column_where(int first, int end, Predicate&& is_true) {
  while (first < end) {
    const int middle = first + (end - first) / 2;
    if (is_true(middle))
      end = middle;
    else
      first = middle + 1;
  }
  return first;
}

}  // namespace pipeline
