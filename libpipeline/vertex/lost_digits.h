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

  /// A triangle before it is printed, and as it was read; of a piece, the uncut triangle until undo_rounding.
  struct Surface {
    Surface(const Triangle& printed, const Triangle& read);
    [[nodiscard]] double at(double x, double y) const {
      return p_ndc[0].z + z_x * (x - p_ndc[0].x) + z_y * (y - p_ndc[0].y);
    }

    Triangle p_ndc, p_view;
    double area;      // twice the signed area in NDC
    double z_x, z_y;  // the slope of its plane
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

  void look_for_decimals();
  void look_at_kept();
  void look_at(std::span<const Triangle> p_ndc, const auto& read);
  void look_along(Row& row, double y, Surface& surface, double reach, std::uint32_t index);
  void undo_rounding(Surface& surface) const;
  [[nodiscard]] Triangle projected(const Triangle& p_view) const;
  [[nodiscard]] double depth_error(const Surface& surface, double z, double read, double written) const;
  [[nodiscard]] double edge_share(const Surface& surface, double z) const;
  [[nodiscard]] Triangle possible_truth(const Surface& surface, unsigned trial) const;
  [[nodiscard]] double wrong_share(const Place& place, double x, double y, unsigned first_trial) const;

  ProjectionTransform projection_;
  ProjectionCoefficients coefficients_;  // set with the rows
  ViewFromClip view_from_clip_;
  double x_scale_, y_scale_, z_scale_;
  double tilt_;                  // 1 in perspective, where what is beside the middle moves with its distance
  std::optional<int> decimals_;  // of the text written
  int decimals_read_;
  // Half a unit of the last decimal, in the text read and in the text written; 0 where no stage rounded it.
  double half_read_ = 0, half_written_;
  double unit_read_ = 0;

  std::vector<Triangle> kept_, kept_read_;  // all triangles, while they are few
  std::size_t triangle_count_ = 0, work_ = 0;
  double farthest_ = 2;        // the largest of all rows
  std::vector<Row> rows_;      // none while triangles are kept
  std::vector<Surface> seen_;  // visible somewhere when added, in the order of the stream
};

}  // namespace pipeline
