# Depths under `center` while doubles hold the weights: DepthInDoubles (libpipeline/coverage/triangle_depth.h).
#
# In units of u = 2^-53 and of Z, the largest |z|. Weights are exact; in parts of their sum, that of vertex a is A, those of b and c
# together 1 - A. In the middle of a span the depth is m, M = |m|; at a pixel it is m + h s, P = |h s|. To the error add
#   1           for three products with weights that add up to 1
#   first       for the sum of the products of b and c, first = |m - A z_a|: at most M + A and at most 1 - A
#   M + M       for the sum of three, and the quotient
#   1           for the products of the slope times h: from the middle to the pixel no weight changes by more than its value
#               in the middle
#   3 P         for the last sum of the slope, the quotient, and the product with h; sums before that lose nothing
#   1           for the sum of both: the depth is at most Z
# M + P is at most 1: the span's ends are in the triangle and are m + h s and m - h s. t1, t2 and t3 are what the three inequalities
# leave: first = M + A - t1 = 1 - A - t2, P = 1 - M - t3.
# Errors of errors: none is carried through more than nine roundings.
# Claim: 6.5 u Z, and a hundredth of u; with u more for decimals that are next to the depths, and as the stated bound, 2^-50 Z.

first = ((M + A - t1) + (1 - A - t2)) / 2;
units = 3 + first + 2 * M + 3 * (1 - M - t3);
error = units * 1b-53 * (1 + e);

{ M in [0, 1] /\ A in [0, 1] /\ t1 in [0, 2] /\ t2 in [0, 1] /\ t3 in [0, 1] /\ |e| <= 1b-49
  -> error <= 0x6.81p-53 /\ error + 1b-53 <= 1b-50 }   # claim

units -> 6.5 - M / 2 - t1 / 2 - t2 / 2 - 3 * t3;
