# How far a text may be from the truth: rounding_error and error_in_view (libpipeline/stream/bounds.h).
#
# The rule. m is the largest |coordinate| of a vertex as its text is read. Printing d decimals is off by half a unit, where a tie may be
# missed by 2^-20 of one more, and reading them by u m, u = 2^-53; all digits are the nearest double. A vertex p of a text with the bound
# A + R |p|, so that the true one is p + D with |D| <= A + R |p| in each coordinate, has the image v = M (p - e), M a rotation, and v is
# printed with an error of a + r m. The true image differs from v by M D: by s (A + R |p|), where s is the largest sum of a row's
# |entries|. As p = e + M^T v, |p| <= |e| + sqrt(3) |v|, for lengths are kept; and |v| <= m + a + r m. So the new bound is
#     A' = s (A + R (|e| + sqrt(3) a)) + a      R' = s sqrt(3) R (1 + r) + r.
# All terms are positive, and each takes part in at most seven roundings, e1 to e7, before the sum is enlarged by 2^-40.
# Claim: they lose at most 2^-50 of it.

kept = (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6) * (1 + e7);

{ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\ |e6| <= 1b-53 /\ |e7| <= 1b-53
  -> |kept - 1| <= 1b-50 } # claim
