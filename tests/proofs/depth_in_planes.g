# Depths under `center` of triangles that are not all decimals: DepthPlane (libpipeline/coverage/center.h), as Planes and
# middle_depth (libpipeline/coverage/double_rows.h) calculate it.
#
# In units of Z, the largest |z| of a vertex. In pixels, the corners are p, q and r; W = |q.u - p.u| + |r.u - p.u|, H likewise of v,
# M the largest |u| or |v| of a corner and the count of pixels added up, k = W H / area, at least 1, and n = k^2 (M_u / W + M_v / H).
# Pairs lose 2^-101 of a product or quotient and 2^-103 of the terms of a sum (pair_product.g, pair_quotient.g, pair_sum.g). So a
# coordinate is off by 2^-101 M, and the area, of two products below W H, by k times 2^-99 (M_u / W + M_v / H) of itself. A slope is
# two products below 2 Z H over the area, at most 2 Z k / W, and off by three times that share of its bound. In the triangle a pixel
# is at most W and H from p: slopes add 12 k^2, the corner and the sums with it 8 k, to 20 n 2^-98 Z in all. n is less than 2^36.
# At the middle of a span the depth is m, at a pixel m + h s; the ends of the span are in the triangle. Added to off_m and off_s are,
# in doubles, the high part of m (e1) and of s (e2), the product with h (e3) and the sum (e4).
# Claim: 2^-50 Z.

middle = m + off_m;
rise = hs + off_s;
error = off_m + off_s + middle * e1 + rise * (e2 + e3 + e2 * e3)
        + (middle * (1 + e1) + rise * (1 + e2) * (1 + e3)) * e4;

{ |m| <= 1 /\ |hs| <= 1 /\ |m + hs| <= 1 /\ n in [1, 1b36]
  /\ |off_m| - n * 20b-98 <= 0 /\ |off_s| - n * 20b-98 <= 0 /\ |off_m| <= 20b-62 /\ |off_s| <= 20b-62
  /\ |middle * (1 + e1) + rise * (1 + e2) * (1 + e3)| <= 0x1.001p0
  /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53
  -> |error| <= 1b-50                                                          # claim
     /\ (middle * (1 + e1) + rise * (1 + e2) * (1 + e3)) * (1 + e4) - (m + hs) - error in [0, 0] }

(middle * (1 + e1) + rise * (1 + e2) * (1 + e3)) * (1 + e4) - (m + hs) - error -> 0;
