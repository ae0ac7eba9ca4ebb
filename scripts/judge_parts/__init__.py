"""The judge of hand-ins, shared by scripts/compare --five and scripts/check-stage. It starts in judge.py."""
