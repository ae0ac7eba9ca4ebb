# The sum of two pairs: operator+(DoubleDouble, DoubleDouble) (libpipeline/numbers/double_double.h).
#
# The sum of the high parts is s and its remainder t, |t| <= u |s|, u = 2^-53; that of the low parts v and its remainder w,
# |w| <= u |v|: both sums lose nothing. Rounded are t + v (e1) and, after an exact sum, w + the remainder of that one (e2), which is
# at most u |s + t + v|, times 1 + 2 u.
# Gappa proves the bound in parts of |a.hi| + |b.hi|, which here is 1: it knows nothing of the cancellation that keeps the error
# within 3 u^2 of the sum itself (M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for basic building blocks of
# double-word arithmetic", ACM TOMS 44(2), 2017, theorem 3.1, which needs a discussion of cases by the exponents of all four
# parts; L. Rideau and J.-M. Muller have checked it with Coq, 2022). For operands of one sign both bounds are alike.
# DoubleDouble.SumIsWithinThreeUnits measures it where all but the last bits cancel.
# Claim: within 2^-103 of |a.hi| + |b.hi|.

{ |s| <= 0x1.000001p0 /\ |t| <= 0x1.000001p-53 /\ |v| <= 0x1.000001p-53 /\ |e1| <= 1b-53
  /\ |rest| <= 0x1.00001p-53 /\ |w| <= 0x1.000001p-106 /\ |e2| <= 1b-53
  -> |(t + v) * e1 + (w + rest) * e2| <= 1b-103 }   # claim
