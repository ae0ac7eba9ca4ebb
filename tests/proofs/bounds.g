# How far a text may be from the truth: rounding_error and error_in_view (libpipeline/stream/bounds.h), and the edge functions of
# libpipeline/picture/true_outline_lanes.h, which has the proof for projection.
#
# The rule. m is the largest |coordinate| of a vertex as its text is read. Printing d decimals is off by half a unit, where a tie may be
# missed by 2^-20 of one more, and reading them by u m, u = 2^-53; all digits are the nearest double. A vertex p of a text with the bound
# A + R |p|, so that the true one is p + D with |D| <= A + R |p| in each coordinate, has the image v = M (p - e), M a rotation, and v is
# printed with an error of a + r m. The true image differs from v by M D: by s (A + R |p|), where s is the largest sum of a row's
# |entries|. As p = e + M^T v, |p| <= |e| + sqrt(3) |v|, for lengths are kept; and |v| <= m + a + r m. So the new bound is
#     A' = s (A + R (|e| + sqrt(3) a)) + a      R' = s sqrt(3) R (1 + r) + r.
# All terms are positive, and each takes part in at most seven roundings, e1 to e7, before the sum is enlarged by 2^-40.
# Claim: they lose at most 2^-50 of it.
#
# A coefficient of an edge function is the difference of two products, each rounded, and then rounded (f). In parts of the sum of their
# absolute values, the products are off by at most u (products), and the difference is at most 1 (whole).
# Claim: off by at most 2^-51; of all terms of a function, 2^-45 X Y is counted.

kept = (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6) * (1 + e7);

{ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\ |e6| <= 1b-53 /\ |e7| <= 1b-53
  /\ |whole| <= 1 /\ |products| <= 1b-53 /\ |f| <= 1b-53
  -> |kept - 1| <= 1b-50                                  # claim
     /\ |(whole + products) * (1 + f) - whole| <= 1b-51 } # claim

(whole + products) * (1 + f) - whole -> products + (whole + products) * f;
