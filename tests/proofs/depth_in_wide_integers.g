# Depths under `center` where doubles do not hold the weights: TriangleDepth (libpipeline/coverage/triangle_depth.h).
#
# In units of Z, the largest |z|. Depths and weights are whole numbers, so sums of products are exact but for the bits cut off:
# depths below 61 bits, less than 3 * 2^-60, and weights below 60 bits, less than 2^-56 together (`cut`).
# The depth m in the middle is rounded four times (to a double, by 2^-53 + 2^-61; the total, its inverse, their product), m1..m4; the
# slope times h five times (to a double, the total, the quotient, the unit, the product with h), s1..s5; the sum once, e. Units are
# powers of two. p is the part of |m| in |m| + |h s|, which is at most 1.
# Claim: 2^-50 Z, with 2^-53 Z less for decimals that are next to the depths.

off_middle = (1 + m1) * (1 + m2) * (1 + m3) * (1 + m4) - 1;
off_slope = (1 + s1) * (1 + s2) * (1 + s3) * (1 + s4) * (1 + s5) - 1;
error = p * |off_middle| + (1 - p) * |off_slope| + |e| * (1 + 1b-49) + cut + 1b-53;

{ |m1| <= 0x1.01p-53 /\ |m2| <= 0x1.01p-53 /\ |m3| <= 1b-53 /\ |m4| <= 1b-53
  /\ |s1| <= 0x1.01p-53 /\ |s2| <= 0x1.01p-53 /\ |s3| <= 1b-53 /\ |s4| <= 1b-53 /\ |s5| <= 1b-53
  /\ |e| <= 1b-53 /\ p in [0, 1] /\ cut in [0, 0x1.3p-56]
  -> error <= 1b-50 }   # claim

p * |off_middle| + (1 - p) * |off_slope| -> |off_slope| + p * (|off_middle| - |off_slope|);
$ p in 64;
