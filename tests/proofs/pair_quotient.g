# The quotient of two pairs: operator/(DoubleDouble, DoubleDouble) (libpipeline/numbers/double_double.h).
#
# In parts of a.hi / b.hi: the low parts are la and lb, at most u = 2^-53; the quotient of the high parts is rounded (e1); its
# product with b is a pair, off by e5 <= 2 u^2 (algorithm DWTimesFP3), with a low part bl, at most u (1 + 3 u). The difference of
# the high parts is exact (Sterbenz' lemma), that of the low parts is rounded (e2), so are their sum (e3), its quotient by b.hi
# (e4). The final sum is exact. With b1 = (1 + lb) (1 + e1) - 1, the rest before roundings is rest = (1 + la) - (1 + b1) (1 + e5),
# and the error of the result, times 1 + lb, is (result) (1 + lb) - (1 + la), where (1 + e1) (1 + lb) = 1 + b1.
# Claim: within 2^-101 of the exact quotient. (The literature has 15 u^2 and 2^-102 is 16 u^2; all that is used is 2^-101.)

b1 = lb + e1 + lb * e1;
rest = la - b1 - (1 + b1) * e5;
computed_rest = (rest + (la - bl) * e2) * (1 + e3) * (1 + e4);
error = ((1 + b1) * e5 * -1 + (la - bl) * e2 * (1 + e3) * (1 + e4) + rest * (e3 + e4 + e3 * e4) + computed_rest * lb) / (1 + la);

{ |la| <= 1b-53 /\ |lb| <= 1b-53 /\ |bl| <= 0x1.001p-53 /\ |e5| <= 1b-105
  /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53
  -> |error| <= 1b-101   # claim
     /\ |error| <= 0x1.8p-102                                                # as ball.g assumes
     /\ ((1 + e1 + computed_rest) * (1 + lb) - (1 + la)) - error * (1 + la) in [0, 0] }

((1 + e1 + computed_rest) * (1 + lb) - (1 + la)) - error * (1 + la) -> 0 { 1 + la <> 0 };
