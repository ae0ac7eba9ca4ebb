# The rounding test: DecimalUnits::is_certain (libpipeline/numbers/decimal_units.h).
#
# `exact` is |value| * scale, the exact product of two doubles; `scaled` that product as rounded, `whole` the whole number
# nearest to it. The test compares |scaled - whole| + scaled * 2^-52, rounded, with 1/2 - 2^-40 - error, rounded.
# Claim: where it is at most that, a number within `error` of `exact` is less than 1/2 from `whole`. (Its distance is at most
# |scaled - whole| + |scaled - exact| + error.)

@fl = float<ieee_64, ne>;

distance = fl(off);                       # off = |scaled - whole|, at most 1/2: whole is the nearest
margin = scaled * 1b-52;                  # exact: a power of two, and far from the subnormal numbers that matter
reach = fl(distance + margin);
limit = fl((0.5 - 1b-40) - error);
lost = scaled * part;                     # |scaled - exact|, where part = |scaled - exact| / scaled

{ scaled in [0, 1b51] /\ off in [0, 0.5] /\ error in [0, 1]
  /\ part in [0, 0x1.001p-53]              # of a rounded product: 2^-53 of the exact one
  /\ reach - limit <= 0
  -> off + lost + error <= 0x1.fffffffffep-2 /\ off + lost + error <= 1b-1 }   # claim

# What the comparison bounds, and what each rounding adds to it.
off + lost + error -> (reach - limit) + (limit - ((0.5 - 1b-40) - error)) + (0.5 - 1b-40)
                      - (reach - (distance + margin)) - (distance - off) + scaled * (part - 1b-52);
