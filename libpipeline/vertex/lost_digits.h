#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// Estimates the share of a picture that shows another surface than it would with all digits. Draws the scene
/// at some places of the window. Where the decimals cannot order the two nearest surfaces, it checks whether
/// they are printed in the true order; for every triangle, it estimates the share over which rounding moves
/// the edges. These shares do not depend on the size of the picture. The numbers to be written are known
/// before they are rounded. The digits lost by the text that is read are not known: some equally likely ones
/// are tried.
class LostDigits {
 public:
  struct Found {
    double share = 0;               // of the pixels drawn
    bool is_of_edges = false;       // true if most of the loss is at edges
    int decimals = 0;               // too few: of the text written or, if it is exact, of the text read
    std::optional<int> enough;      // with so many, no pixel should be wrong; none if 12 are too few
    bool may_be_one_plane = false;  // most of the loss is at surfaces that perhaps no digits tell apart
    bool near_helps = false;        // a larger near would lose fewer digits and hide nothing
  };

  /// `decimals` of the text written, none if it is exact; `decimals_read` of the first number read.
  LostDigits(const ProjectionTransform& projection, std::optional<int> decimals,
             std::optional<int> decimals_read);

  /// Adds triangles as they were read and as they are before they are printed.
  void add(const TriangleBatch& p_view, const TriangleBatch& p_ndc);
  /// The losses found, after the last triangle; none below a two-hundredth of the pixels drawn.
  [[nodiscard]] std::optional<Found> found();

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Half a unit of the last decimal, in the text read and in the text written; 0 for an exact text.
  struct HalfUnits {
    double read = 0, written = 0;
  };
  /// The plane of a triangle: depths over the window.
  struct Plane {
    Plane() = default;
    explicit Plane(const Triangle& p_ndc);
    [[nodiscard]] double at(double x, double y) const {
      return z + z_x * (x - corner.x) + z_y * (y - corner.y);
    }

    Vec3 corner;
    double z = 0, z_x = 0, z_y = 0;
    double area = 0;  // twice the triangle's signed area
  };
  /// A triangle before it is printed, and as it was read; of a piece, the uncut triangle until undo_rounding.
  struct Surface {
    Triangle p_ndc, p_view;
    Plane plane = {};
    double reach = 0;  // a bound on the error in depth
  };
  struct Place {
    double z = 2;                   // nothing
    double reach = 0;               // of the nearest surface
    double gap = 0;                 // in depth, to the rival
    std::uint32_t nearest = kNone;  // an index of seen_
    std::uint32_t rival = kNone;    // a surface that may be nearer
  };
  struct Row {
    double farthest = 2;  // no place's z + reach is larger
    unsigned look_count = 0;
    std::vector<Place> places;
  };
  /// Some values of x or y over the window, one of them near the middle.
  struct Steps {
    static constexpr double kMiddle = 0.0037, kOdd = 0.13;  // so that they hit no grid of vertices
    [[nodiscard]] double at(std::size_t index) const {
      return (static_cast<double>(index) - (static_cast<double>(count) - 1) / 2) / per_unit + kMiddle;
    }
    /// The index of the first step that is at least `value`.
    [[nodiscard]] std::size_t from(double value) const;
    /// Keeps every third step, from the second on.
    void thin_out() {
      count /= 3;
      per_unit /= 3;
    }

    std::size_t count = 81;  // a power of 3: odd
    double per_unit = (81 + kOdd) / 2;
  };
  /// A place where the decimals cannot tell which surface is nearer.
  struct Close {
    double gap, z;
    const Surface &a, &b;
  };
  /// Counts of places; those that may be wrong count by their share.
  struct Losses {
    double shown = 0, wrong = 0, at_edges = 0, in_one_plane = 0;
    double nearest = 2;  // the least z
    std::vector<Close> close;
  };

  void look_for_decimals();
  void look_at_kept();
  [[nodiscard]] std::size_t count_between_rows(std::span<const Triangle> p_ndc) const;
  void look_at(const Triangle& p_ndc, const Triangle& p_view, std::size_t most_work);
  void look_along(Row& row, double y, Surface& surface, std::uint32_t& index);
  void look_at(Place& place, double z, Surface& surface, std::uint32_t& index);
  void thin_out();
  void undo_rounding(Surface& surface) const;
  [[nodiscard]] Triangle projected(const Triangle& p_view) const;
  [[nodiscard]] double depth_error(const Plane& plane, double z, const HalfUnits& half) const;
  [[nodiscard]] double edge_share(const Place& place) const;
  [[nodiscard]] Triangle possible_truth(const Surface& surface, unsigned trial) const;
  [[nodiscard]] double depth_error(const Close& close, const HalfUnits& half) const;
  void add_rival(const Place& place, double x, double y, Losses& losses) const;
  [[nodiscard]] Losses losses() const;
  [[nodiscard]] bool suffice(int more_decimals, const Losses& losses) const;
  [[nodiscard]] double wrong_share(const Place& place, double x, double y, unsigned first_trial) const;

  ProjectionTransform projection_;
  ProjectionCoefficients coefficients_;  // set with the rows
  ViewFromClip view_from_clip_;
  double x_scale_, y_scale_;
  std::optional<int> decimals_;  // of the text written
  int decimals_read_;
  double unit_read_ = 0;  // a unit of the last decimal read, if a stage has rounded it
  HalfUnits half_;

  std::vector<Surface> kept_;  // all triangles, while they are few
  std::size_t triangle_count_ = 0, work_ = 0;
  Steps ys_, columns_;
  double farthest_ = 2;        // the largest of all rows
  std::vector<Row> rows_;      // none while triangles are kept
  std::vector<Surface> seen_;  // visible somewhere when added, in the order of the stream
};

}  // namespace pipeline
