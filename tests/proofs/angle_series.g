# The series of sine and 1 - cosine: sine_cosine_of_reduced and kSeriesError (libpipeline/numbers/angle.cpp).
#
# x is the angle in radians, at most pi / 4; as calculated it is off by 2^-103 of itself (pair_product.g) and by 2^-109 (pi / 180), together
# less than 2^-102. t = x^2 is at most 0.61686, and off by twice that and 2^-103 of itself (toff).
# Horner's rule, from the last of 14 coefficients on. In parts of its coefficient, each sum is h = 1 - t / q h', where q is the quotient of two
# neighboring coefficients and h' the sum before. s1, s2 ... and v1, v2 ... are the errors of h, for the sine and for 1 - cosine, each from that
# of h' by the roundings of the product, 2^-103 (pair_product.g), the coefficient, 2^-107, and the difference, 2^-103 of the sum of its terms
# (pair_sum.g). The last h lacks the omitted terms.
# Claim: either within 2^-99 of the exact sine, or 1 - cosine.

s12 = t / 702 * (s13 + (sh13 + s13) * sm13) + sc13 + (1 + t / 702 * sh13) * sd13 * 0x1.01p0;
s11 = t / 600 * (s12 + (sh12 + s12) * sm12) + sc12 + (1 + t / 600 * sh12) * sd12 * 0x1.01p0;
s10 = t / 506 * (s11 + (sh11 + s11) * sm11) + sc11 + (1 + t / 506 * sh11) * sd11 * 0x1.01p0;
s9 = t / 420 * (s10 + (sh10 + s10) * sm10) + sc10 + (1 + t / 420 * sh10) * sd10 * 0x1.01p0;
s8 = t / 342 * (s9 + (sh9 + s9) * sm9) + sc9 + (1 + t / 342 * sh9) * sd9 * 0x1.01p0;
s7 = t / 272 * (s8 + (sh8 + s8) * sm8) + sc8 + (1 + t / 272 * sh8) * sd8 * 0x1.01p0;
s6 = t / 210 * (s7 + (sh7 + s7) * sm7) + sc7 + (1 + t / 210 * sh7) * sd7 * 0x1.01p0;
s5 = t / 156 * (s6 + (sh6 + s6) * sm6) + sc6 + (1 + t / 156 * sh6) * sd6 * 0x1.01p0;
s4 = t / 110 * (s5 + (sh5 + s5) * sm5) + sc5 + (1 + t / 110 * sh5) * sd5 * 0x1.01p0;
s3 = t / 72 * (s4 + (sh4 + s4) * sm4) + sc4 + (1 + t / 72 * sh4) * sd4 * 0x1.01p0;
s2 = t / 42 * (s3 + (sh3 + s3) * sm3) + sc3 + (1 + t / 42 * sh3) * sd3 * 0x1.01p0;
s1 = t / 20 * (s2 + (sh2 + s2) * sm2) + sc2 + (1 + t / 20 * sh2) * sd2 * 0x1.01p0;
s0 = t / 6 * (s1 + (sh1 + s1) * sm1) + sc1 + (1 + t / 6 * sh1) * sd1 * 0x1.01p0;

v12 = t / 756 * (v13 + (vh13 + v13) * vm13) + vc13 + (1 + t / 756 * vh13) * vd13 * 0x1.01p0;
v11 = t / 650 * (v12 + (vh12 + v12) * vm12) + vc12 + (1 + t / 650 * vh12) * vd12 * 0x1.01p0;
v10 = t / 552 * (v11 + (vh11 + v11) * vm11) + vc11 + (1 + t / 552 * vh11) * vd11 * 0x1.01p0;
v9 = t / 462 * (v10 + (vh10 + v10) * vm10) + vc10 + (1 + t / 462 * vh10) * vd10 * 0x1.01p0;
v8 = t / 380 * (v9 + (vh9 + v9) * vm9) + vc9 + (1 + t / 380 * vh9) * vd9 * 0x1.01p0;
v7 = t / 306 * (v8 + (vh8 + v8) * vm8) + vc8 + (1 + t / 306 * vh8) * vd8 * 0x1.01p0;
v6 = t / 240 * (v7 + (vh7 + v7) * vm7) + vc7 + (1 + t / 240 * vh7) * vd7 * 0x1.01p0;
v5 = t / 182 * (v6 + (vh6 + v6) * vm6) + vc6 + (1 + t / 182 * vh6) * vd6 * 0x1.01p0;
v4 = t / 132 * (v5 + (vh5 + v5) * vm5) + vc5 + (1 + t / 132 * vh5) * vd5 * 0x1.01p0;
v3 = t / 90 * (v4 + (vh4 + v4) * vm4) + vc4 + (1 + t / 90 * vh4) * vd4 * 0x1.01p0;
v2 = t / 56 * (v3 + (vh3 + v3) * vm3) + vc3 + (1 + t / 56 * vh3) * vd3 * 0x1.01p0;
v1 = t / 30 * (v2 + (vh2 + v2) * vm2) + vc2 + (1 + t / 30 * vh2) * vd2 * 0x1.01p0;
v0 = t / 12 * (v1 + (vh1 + v1) * vm1) + vc1 + (1 + t / 12 * vh1) * vd1 * 0x1.01p0;

# In parts of the sum h itself (sh0, vh0), with the error of t and the product with x, or with t, that follows.
sine = (s0 + t / 6 * toff) / sh0 + last + xoff;
versine = (v0 + t / 12 * toff) / vh0 + last + toff;

{ t in [0, 0x0.9df0p0] /\ |xoff| <= 1b-102 /\ |toff| <= 0x2.81p-102 /\ |last| <= 1b-103 /\ sh0 in [0x0.e6p0, 1] /\ vh0 in [0x0.f2p0, 1]
  /\ s13 in [0, 0x0.00c8p0] /\ v13 in [0, 0x0.00c0p0]   # the omitted terms: t / 812 and t / 870
  /\ sh1 in [0x0.f8p0, 1] /\ |sm1| <= 1b-103 /\ |sc1| <= 1b-107 /\ |sd1| <= 1b-103
  /\ sh2 in [0x0.f8p0, 1] /\ |sm2| <= 1b-103 /\ |sc2| <= 1b-107 /\ |sd2| <= 1b-103
  /\ sh3 in [0x0.f8p0, 1] /\ |sm3| <= 1b-103 /\ |sc3| <= 1b-107 /\ |sd3| <= 1b-103
  /\ sh4 in [0x0.f8p0, 1] /\ |sm4| <= 1b-103 /\ |sc4| <= 1b-107 /\ |sd4| <= 1b-103
  /\ sh5 in [0x0.f8p0, 1] /\ |sm5| <= 1b-103 /\ |sc5| <= 1b-107 /\ |sd5| <= 1b-103
  /\ sh6 in [0x0.f8p0, 1] /\ |sm6| <= 1b-103 /\ |sc6| <= 1b-107 /\ |sd6| <= 1b-103
  /\ sh7 in [0x0.f8p0, 1] /\ |sm7| <= 1b-103 /\ |sc7| <= 1b-107 /\ |sd7| <= 1b-103
  /\ sh8 in [0x0.f8p0, 1] /\ |sm8| <= 1b-103 /\ |sc8| <= 1b-107 /\ |sd8| <= 1b-103
  /\ sh9 in [0x0.f8p0, 1] /\ |sm9| <= 1b-103 /\ |sc9| <= 1b-107 /\ |sd9| <= 1b-103
  /\ sh10 in [0x0.f8p0, 1] /\ |sm10| <= 1b-103 /\ |sc10| <= 1b-107 /\ |sd10| <= 1b-103
  /\ sh11 in [0x0.f8p0, 1] /\ |sm11| <= 1b-103 /\ |sc11| <= 1b-107 /\ |sd11| <= 1b-103
  /\ sh12 in [0x0.f8p0, 1] /\ |sm12| <= 1b-103 /\ |sc12| <= 1b-107 /\ |sd12| <= 1b-103
  /\ sh13 in [0x0.f8p0, 1] /\ |sm13| <= 1b-103 /\ |sc13| <= 1b-107 /\ |sd13| <= 1b-103
  /\ vh1 in [0x0.f8p0, 1] /\ |vm1| <= 1b-103 /\ |vc1| <= 1b-107 /\ |vd1| <= 1b-103
  /\ vh2 in [0x0.f8p0, 1] /\ |vm2| <= 1b-103 /\ |vc2| <= 1b-107 /\ |vd2| <= 1b-103
  /\ vh3 in [0x0.f8p0, 1] /\ |vm3| <= 1b-103 /\ |vc3| <= 1b-107 /\ |vd3| <= 1b-103
  /\ vh4 in [0x0.f8p0, 1] /\ |vm4| <= 1b-103 /\ |vc4| <= 1b-107 /\ |vd4| <= 1b-103
  /\ vh5 in [0x0.f8p0, 1] /\ |vm5| <= 1b-103 /\ |vc5| <= 1b-107 /\ |vd5| <= 1b-103
  /\ vh6 in [0x0.f8p0, 1] /\ |vm6| <= 1b-103 /\ |vc6| <= 1b-107 /\ |vd6| <= 1b-103
  /\ vh7 in [0x0.f8p0, 1] /\ |vm7| <= 1b-103 /\ |vc7| <= 1b-107 /\ |vd7| <= 1b-103
  /\ vh8 in [0x0.f8p0, 1] /\ |vm8| <= 1b-103 /\ |vc8| <= 1b-107 /\ |vd8| <= 1b-103
  /\ vh9 in [0x0.f8p0, 1] /\ |vm9| <= 1b-103 /\ |vc9| <= 1b-107 /\ |vd9| <= 1b-103
  /\ vh10 in [0x0.f8p0, 1] /\ |vm10| <= 1b-103 /\ |vc10| <= 1b-107 /\ |vd10| <= 1b-103
  /\ vh11 in [0x0.f8p0, 1] /\ |vm11| <= 1b-103 /\ |vc11| <= 1b-107 /\ |vd11| <= 1b-103
  /\ vh12 in [0x0.f8p0, 1] /\ |vm12| <= 1b-103 /\ |vc12| <= 1b-107 /\ |vd12| <= 1b-103
  /\ vh13 in [0x0.f8p0, 1] /\ |vm13| <= 1b-103 /\ |vc13| <= 1b-107 /\ |vd13| <= 1b-103
  -> |sine| <= 1b-99 /\ |versine| <= 1b-99 }   # claim
