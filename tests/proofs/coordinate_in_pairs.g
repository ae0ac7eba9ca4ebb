# A coordinate in pairs and the bound on its error: image_in_pairs and projected_in_pairs (libpipeline/vertex/vertex_lanes.h) with the
# errors of Coefficient (libpipeline/vertex/vertex_kernel.cpp).
#
# In parts of the sum of the terms' absolute values: each term is a product of pairs, within 2^-102 (pair_product.g), of a coordinate
# relative to the origin, which is exact, and a coefficient, whose own radius Coefficient adds. The high parts are added exactly, three
# times; the remainders (three of at most u = 2^-53 each, in parts of the largest sum) and the low parts (four, together at most u and 4 u^2)
# are added in six rounded sums, each of at most 4 u + 2^-100, so off by 6 times that times u (f), and then exactly to the high part. A
# projection divides by w, with a correction, as pair_quotient.g, within 2^-101.
# Claim: within 2^-98 of that sum. Coefficient assumes 2^-94, which leaves room for the roundings of the bound.

sum = 1 + products + f * (4b-53 + 1b-100);
error = sum * (1 + quotient) - 1;

{ |products| <= 1b-102 /\ |f| <= 6b-53 /\ |quotient| <= 1b-101
  -> |error| <= 1b-98 }   # claim

error -> (sum - 1) + sum * quotient;
sum - 1 -> products + f * (4b-53 + 1b-100);
