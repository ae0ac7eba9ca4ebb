# Depths under `nearest` of steep and narrow triangles: DepthInPairs (libpipeline/coverage/nearest.h, libpipeline/coverage/nearest.cpp).
#
# In units of Z, the largest |z| of a vertex, or the |z| of the plane at the pixel if that is larger. At the middle of the span the
# depth is m, at a pixel m + h s. Those at the ends of the span are at most 4: what the row reaches beyond the triangle is less than
# a pixel, and the triangle is no wider than the pixels it has; so are |m| and |h s|.
# In pairs, differences of coordinates are exact. Slopes are two products, a difference and a quotient; x and y of the pixel a
# quotient; the depth is two differences, products and sums. By pair_product.g, pair_quotient.g and pair_sum.g, m and h s are off by at
# most 128 u^2 Z times the condition number (1 + T) (|sx| (|x| + |a.x|) + |sy| (|y| + |a.y|) + Z) / Z + R. There a is the vertex opposite to
# the longest edge, T the sum of the area's two products over the area, and R = ((|by| + |cy|) |x - a.x| + (|bx| + |cx|) |y - a.y|) / area.
# Added to that are, in doubles, the high part of m (e1) and of s (e2), the product with h (e3) and the sum (e4).
# Not covered: a condition number above 2^43. (Where the slopes are 2^10 Z, that takes a triangle 2^33 times as long as wide.)
# Claim: 2^-49 Z.

middle = m + off_m;
rise = hs + off_s;
error = off_m + off_s + middle * e1 + rise * (e2 + e3 + e2 * e3)
        + (middle * (1 + e1) + rise * (1 + e2) * (1 + e3)) * e4;

{ |m| <= 4 /\ |hs| <= 4 /\ |m + hs| <= 1 /\ number in [1, 1b43]
  /\ |off_m| - number * 128b-106 <= 0 /\ |off_s| - number * 128b-106 <= 0 /\ |off_m| <= 128b-63 /\ |off_s| <= 128b-63
  /\ |middle * (1 + e1) + rise * (1 + e2) * (1 + e3)| <= 0x1.001p0
  /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53
  -> |error| <= 1b-49                                                          # claim
     /\ (middle * (1 + e1) + rise * (1 + e2) * (1 + e3)) * (1 + e4) - (m + hs) - error in [0, 0] }

(middle * (1 + e1) + rise * (1 + e2) * (1 + e3)) * (1 + e4) - (m + hs) - error -> 0;
