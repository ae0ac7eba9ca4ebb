#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "libpipeline/certainty/uncertain_polygon.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The pixels whose centers a true triangle may cover, those whose centers it surely covers, and the depths
/// it may have there, by row.
class Outline {
 public:
  /// A row of it. Columns are counted from first_column().
  struct Row {
    RowRange possible, sure;             // columns; the sure ones are possible, too
    double nearest_at_0, farthest_at_0;  // bounds on depths at column 0, if not beyond those of all
  };

  /// On a picture of this size.
  Outline(const UncertainPolygon& polygon, int columns, int rows);

  /// Leaves out what is nearer than a depth that lies between two limits.
  void cut_before(const std::array<double, 2>& front);

  [[nodiscard]] const RowRange& rows() const { return rows_; }
  [[nodiscard]] int first_column() const { return columns_.first; }
  [[nodiscard]] Row row(int row) const;
  [[nodiscard]] double nearest(const Row& on, int column) const {
    return std::max(on.nearest_at_0 + nearest_.per_column * column, least_);
  }
  [[nodiscard]] double farthest(const Row& on, int column) const {
    return std::min(on.farthest_at_0 + farthest_.per_column * column, greatest_);
  }

 private:
  /// A linear function of the column and row, counted from the first ones.
  struct Linear {
    [[nodiscard]] double in_row(double row) const { return per_row * row + at_0; }
    [[nodiscard]] double at(double column, double row) const { return per_column * column + in_row(row); }

    double per_column, per_row, at_0;
  };
  /// Where a function is at least the first limit, a center may be covered; it surely is where all are above
  /// the second one.
  struct Side {
    Linear inside;
    double possible_from, sure_from;
  };

  void set_sides(const UncertainPolygon& polygon, double width, double height);
  void set_depths(const UncertainPolygon& polygon, double width, double height);

  RowRange columns_, rows_;
  std::array<Side, UncertainPolygon::kMaxPoints + 2> sides_;
  std::size_t side_count_ = 0;
  Linear nearest_ = {}, farthest_ = {};
  double least_, greatest_;
};

}  // namespace pipeline
