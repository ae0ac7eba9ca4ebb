# The x or y of a pixel center in doubles: Viewport::dx, Viewport::left_x (libpipeline/scene/viewport.h), PixelGrid::x_of
# (libpipeline/scene/viewport.h); rows alike.
#
# In parts of the window's half width: the center is -1 + d (n + 1/2), where d = 2 / columns. d is rounded (e1), so is the sum
# -1 + d / 2 (e2), the product n d (e3), and their sum (e4). walk = n d is at most 2, half = d / 2 at most 1.
# Claim: off by at most 2^-50 times the half width (nearest_depth.g counts 7 * 2^-53).

computed = ((-1 + half * (1 + e1)) * (1 + e2) + walk * (1 + e1) * (1 + e3)) * (1 + e4);
error = half * e1 + (-1 + half * (1 + e1)) * e2 + walk * (e1 + e3 + e1 * e3)
        + ((-1 + half * (1 + e1)) * (1 + e2) + walk * (1 + e1) * (1 + e3)) * e4;

{ half in [0, 1] /\ -1 + half * (1 + e1) in [-1, 0x1.1p-53] /\ walk in [0, 2]
  /\ (-1 + half * (1 + e1)) * (1 + e2) + walk * (1 + e1) * (1 + e3) in [-0x1.001p0, 0x1.001p0]
  /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53
  -> |error| <= 0x7.1p-53 /\ |error| <= 1b-50                                  # claim
     /\ computed - (-1 + half + walk) - error in [0, 0] }

computed - (-1 + half + walk) - error -> 0;
