# The product of two pairs: operator*(DoubleDouble, DoubleDouble) (libpipeline/numbers/double_double.h), and product()
# (libpipeline/vertex/vertex_lanes.h), which has no fused multiply-add and rounds once more.
#
# In parts of a.hi b.hi: the low parts are la and lb, at most u = 2^-53; the product of the high parts is off by ph, which is
# known exactly; the cross products are rounded (e0, e1), their sum (e2), and the sum with ph (e3). The final sum is exact.
# Claims: within 2^-103 of the exact product, and within 2^-102. (The literature has 5 u^2; 2^-103 is 8 u^2, and all that is
# used.)

cross = (la + lb * (1 + e1)) * (1 + e2);
error = (lb * e1 + (la + lb * (1 + e1)) * e2 + (ph + cross) * e3 - la * lb) / ((1 + la) * (1 + lb));

plain_cross = (la * (1 + e0) + lb * (1 + e1)) * (1 + e2);
plain_error = (la * e0 + lb * e1 + (la * (1 + e0) + lb * (1 + e1)) * e2 + (ph + plain_cross) * e3 - la * lb) / ((1 + la) * (1 + lb));

{ |la| <= 1b-53 /\ |lb| <= 1b-53 /\ |ph| <= 1b-53 /\ |e0| <= 1b-53 /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53
  -> |error| <= 1b-103 /\ |plain_error| <= 1b-102   # claim
     /\ |error| <= 0x7.4p-106                                                 # as ball.g assumes
     # That is the error: (1 + computed parts) - (1 + la) (1 + lb).
     /\ (ph + cross) * (1 + e3) - ph - (la + lb + la * lb) - error * ((1 + la) * (1 + lb)) in [0, 0] }

(ph + cross) * (1 + e3) - ph - (la + lb + la * lb) - error * ((1 + la) * (1 + lb)) -> 0 { (1 + la) * (1 + lb) <> 0 };
