# Depths under `nearest` in doubles: NearestRows (libpipeline/coverage/nearest.h, libpipeline/coverage/nearest.cpp) and its twin on vectors.
#
# The depth of the plane through the vertices a (lowest), b, c at a pixel is z0 + (x - x0) slope, from the row's left intersection
# (x0, z0). In units of u = 2^-53 and of Z, the largest |z| of a vertex, or the |z| of the plane at the pixel if that is larger; L
# and B are half the width and height of the window, E = |b.x - a.x| + |c.x - a.x|, H = c.y - a.y, sx and sy the plane's slopes.
# To the error add
#   7 |sx| L + 7 |sy| B   for x and y of the pixel center (pixel_center.g)
#   3 |sy| H              for the place of the intersection on its edge, (y - lower.y) / (upper.y - lower.y), off by 3 u: that is a
#                         point of the edge above or below the row
#   2 |sx| E              for its x: a difference and a product
#   |sx| L + 2            and a sum: |x0| is at most L + |x - x0|, and |sx (x - x0)| at most 2 Z
#   5                     for its z: a difference and a product, of at most 2 Z, and a sum
#   2 + 2                 for the difference x - x0 and the product with the slope
#   1                     for the last sum
#   2 + 6 reach (|sx| E + |sy| H)   for the slope: the quotient; and the terms of area and rise, each with three roundings. In
#                         parts of the area, the error of either is at most 3 (|sx| (|bx cy| + |cx by|) + 2 |sy| |by| cy), and
#                         reach = |x - x0| H / |area| counts the widths of the triangle's widest row to the pixel: at most 1
#                         between the ends of the row, and 1 + 2^11 half a pixel beyond them, because that row is wider than 2^-12
#                         of a pixel (kNarrowestRow).
# NearestRows calculates so only where |sx| (L + E) + |sy| (B + H) <= 3 * 2^9 Z (kSteepest, the sum of three |z|). Its comparison is
# in doubles; `change` has room for that: the area is off by at most 3 * 2^-13 of itself (kNarrowest), and the rises add at most
# 12 u (L + E) / w, less than one while vertices and window are within 2^46 times w, the triangle's widest row, of each other.
# `slack` is for errors of errors.
# Not covered: triangles that doubles take to be seen edge-on (area <= 3.0...1 u of its terms), rows whose two intersections
# have the same x as doubles, and coordinates outside 2^-400 to 2^400: products there may overflow or lose digits.
# Claims: 2^-39 Z between the ends of a row, 2^-28 Z beyond them.

units = 7 * (xL + yB) + 3 * yH + 2 * xE + xL + 14 + 6 * reach * (xE + yH);   # xL = |sx| L and so on
change = xL + xE + yB + yH;
error = (9 * change + 14) * 1b-53 * slack;
beyond = (9 * change + 6 * (reach - 1) * change + 14) * 1b-53 * slack;

{ xL in [0, 1540] /\ xE in [0, 1540] /\ yB in [0, 1540] /\ yH in [0, 1540] /\ change in [0, 1540] /\ slack in [1, 0x1.01p0] /\ reach in [1, 2050]
  -> error <= 1b-39 /\ beyond <= 1b-28                                         # claim
     # `units` is at most what these two count: with reach = 1, and in general.
     /\ (9 * change + 14) - (7 * (xL + yB) + 3 * yH + 2 * xE + xL + 14 + 6 * (xE + yH)) >= 0
     /\ (9 * change + 6 * (reach - 1) * change + 14) - units >= 0 }

(9 * change + 14) - (7 * (xL + yB) + 3 * yH + 2 * xE + xL + 14 + 6 * (xE + yH)) -> xL + xE + 2 * yB;
(9 * change + 6 * (reach - 1) * change + 14) - units -> xL + xE + 2 * yB + 6 * (reach - 1) * (xL + yB);
