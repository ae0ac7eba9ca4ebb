# The root of a pair: sqrt(DoubleDouble) (libpipeline/numbers/double_double.h).
#
# In parts of sqrt(a.hi): the root of the high part is rounded: 1 + e1. Its square is (1 + e1)^2; the rest 1 - (1 + e1)^2 is
# exact (a fused multiply-add of a number that a double holds), the low part la is added and rounded (e2), the quotient by twice
# the root is rounded (e3), and the final sum is exact. The exact root of 1 + la is 1 + r; r is known only by
# (1 + r)^2 = 1 + la, so with d = the error before the roundings, d = (1 + la - (1 + r)^2 + ...) = (r - e1)^2 / (2 (1 + e1)).
# Claim: within 2^-101 of the exact root. (The literature has 4 u^2; all that is used is 2^-101.)

rest = (r - e1) * (2 + r + e1);           # 1 + la - (1 + e1)^2, by (1 + r)^2 = 1 + la
error = ((r - e1) * (r - e1) + rest * (e2 + e3 + e2 * e3)) / (2 * (1 + e1)) / (1 + r);

{ |e1| <= 1b-53 /\ |r| <= 0x1.001p-54 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53
  -> |error| <= 1b-101   # claim
     /\ |error| <= 0x1.8p-102                                                # as ball.g assumes
     /\ (1 + e1 + rest * (1 + e2) * (1 + e3) / (2 * (1 + e1)) - (1 + r)) - error * (1 + r) in [0, 0] }

(1 + e1 + rest * (1 + e2) * (1 + e3) / (2 * (1 + e1)) - (1 + r)) - error * (1 + r) -> 0 { 1 + r <> 0, 1 + e1 <> 0 };
