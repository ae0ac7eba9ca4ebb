"""The judge of hand-ins, shared by scripts/compare --hand-in, scripts/check-stage and scripts/grade. It
starts in judge.py."""
