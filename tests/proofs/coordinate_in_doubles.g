# A coordinate in doubles and the bound on its error: image_in_doubles and quotient_in_doubles (libpipeline/vertex/vertex_lanes.h)
# with the errors of Coefficient (libpipeline/vertex/vertex_kernel.cpp).
#
# a x + b y + c z + d: each term is a product that is rounded in the coefficient, in the difference of coordinate and origin, in
# the product and in at most three sums; for projections, in the coefficient, the product, the sum, the quotient, and, for a depth,
# two differences and a product more. The bound is 8 u |a| |x| for each term, u = 2^-53, calculated in doubles with at most eight
# roundings of its own. Each rounding is a factor 1 + e, |e| <= u.
# Claim: the exact term is within the calculated bound: factor - 1 is at most 8 u (1 - u)^8. Bounds of terms add up.

term = (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5) * (1 + e6) - 1;
bound = 1b-50 * ((1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5) * (1 + f6) * (1 + f7) * (1 + f8));

{ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\ |e6| <= 1b-53
  /\ |f1| <= 1b-53 /\ |f2| <= 1b-53 /\ |f3| <= 1b-53 /\ |f4| <= 1b-53
  /\ |f5| <= 1b-53 /\ |f6| <= 1b-53 /\ |f7| <= 1b-53 /\ |f8| <= 1b-53
  -> |term / bound| <= 1b0 }   # claim
