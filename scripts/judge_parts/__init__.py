"""The judge of hand-ins, shared by scripts/compare --five, scripts/check-stage and scripts/grade. It starts in judge.py."""
