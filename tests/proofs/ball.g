# The errors that operations add to a ball's: Ball::add_parts, operator*, operator/, sqrt (libpipeline/numbers/ball.h, libpipeline/numbers/ball.cpp).
#
# An operation on midpoints is off by `lost`, in parts of the exact result: less than 7.5 u^2 for sums and products, u = 2^-53
# (pair_product.g; for sums 3 u^2, see pair_sum.g), 24 u^2 for quotients and roots (pair_quotient.g, pair_root.g). What is added is 2^-103
# (kAddMulBound) or 2^-101 (kDivSqrtBound) of the high part as calculated, which is low by u and by what was lost, rounded twice, times
# kRoundUp = 1 + 2^-40. Products: the radius |a| eb + |b| ea + ea eb is calculated from high parts, each low by u, with five roundings.
# Claim: what is added is at least what was lost: the quotients are at most 1.

added = 1b-103 * (1 - 1b-52) * (1 + 1b-40) * (1 + g1) * (1 + g2);
added_to_quotient = 4 * added;
radius = (1 - 1b-53) * (1 + g1) * (1 + g2) * (1 + g3) * (1 + g4) * (1 + 1b-40) * (1 + g5);

{ lost in [0, 0x7.8p-106] /\ lost_by_quotient in [0, 0x1.8p-102]
  /\ |g1| <= 1b-53 /\ |g2| <= 1b-53 /\ |g3| <= 1b-53 /\ |g4| <= 1b-53 /\ |g5| <= 1b-53
  -> lost / added <= 1b0 /\ lost_by_quotient / added_to_quotient <= 1b0 /\ 1 / radius <= 1b0 }   # claim
